classdef CagedynBatch < handle
    % Several bearings at once, on all cores, each with the results that it has alone.
    %
    %   runs = {Cagedyn(scene, {'inner_ring.speed.constant=-300'}), Cagedyn(scene, {'inner_ring.speed.constant=-400'})};
    %   batch = CagedynBatch(runs);
    %   batch.advance_to(0.1);
    %
    % They belong to this batch from then on, and can be used as before while it does not run.

    properties (SetAccess = private)
        runs
    end

    properties (Access = private)
        batch
    end

    methods
        function b = CagedynBatch(runs)
            % Of a cell array of Cagedyn.
            b.runs = runs;
            b.batch = cagedyn_mex('batch', cellfun(@(run) run.sim, runs));
        end

        function delete(b)
            try
                if ~isempty(b.batch), cagedyn_mex('free_batch', b.batch); end
            catch
                % As in Cagedyn.
            end
        end

        function failures = advance_to(b, t, threads)
            % All to time t in s, on so many threads, on all cores without. When some of them fail, that is an error after all others
            % have arrived; failures = advance_to(...) gives the message of each instead, '' for those that have arrived. Ctrl-C
            % stops all after a step, and so does cancel; they can then go on.
            if nargin < 3, threads = 0; end
            count = numel(b.runs);
            names = repmat({''}, count, 1);
            failures = names;
            going = true(count, 1);
            while any(going)
                now = cagedyn_mex('batch_advance', b.batch, t, threads, 0.2 * going);
                late = strcmp(now(:, 1), 'ERR_OUT_OF_TIME');
                ended = going & ~late;
                names(ended) = now(ended, 1);
                failures(ended) = now(ended, 2);
                going = going & late;
                drawnow;
            end
            failed = find(~cellfun(@isempty, names));
            if nargout == 0 && ~isempty(failed)
                first = failed(1);
                error(['cagedyn:' names{first}], '%d of %d failed; number %d: %s', numel(failed), count, first, failures{first});
            end
        end

        function cancel(b)
            % As Cagedyn.cancel, for all of them.
            cagedyn_mex('batch_cancel', b.batch);
        end
    end
end
