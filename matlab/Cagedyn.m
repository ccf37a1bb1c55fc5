classdef Cagedyn < handle
    % Dynamics of the cage, the rolling elements and the rings of a rolling bearing.
    %
    %   b = Cagedyn('scenes/nu2310.json');
    %   b.advance_to(0.01);
    %   b.output('cage.y_ratio')
    %
    % SI units, angles in rad. Names, units and meanings: b.states, b.inputs, b.outputs, b.contacts, b.contact_quantities,
    % b.bodies, b.force_sources, b.force_components; b.units('output'), b.descriptions('output'). Failures of the library are
    % errors with the identifier cagedyn:ERR_... . CagedynBatch runs several at once, CagedynHeat finds temperatures. They need the
    % compiled gateway cagedyn_mex: see build_cagedyn.

    properties (SetAccess = private)
        states, inputs, outputs, contacts, contact_quantities, bodies, force_sources, force_components
    end

    properties (SetAccess = private, Hidden)
        % Handles of the gateway.
        model, sim
    end

    methods
        function b = Cagedyn(scene, overrides, preset)
            % Cagedyn(SCENE): of a scene file, or of its JSON text. Cagedyn(SCENE, OVERRIDES): with some values replaced, one
            % line 'path=value' each in a cell array. Cagedyn(SCENE, OVERRIDES, PRESET): 'draft', 'engineering', 'reference'.
            if isempty(strfind(scene, '{'))
                scene = fileread(scene);
            end
            lines = '';
            if nargin > 1 && ~isempty(overrides)
                lines = sprintf('%s\n', overrides{:});
            end
            b.model = cagedyn_mex('model', scene, lines);
            if nargin > 2
                place = find(strcmp({'draft', 'engineering', 'reference'}, preset)) - 1;
                if isempty(place)
                    error('cagedyn:usage', 'there is no preset %s', preset);
                end
                b.sim = cagedyn_mex('sim', b.model, place);
            else
                b.sim = cagedyn_mex('sim', b.model);
            end
            b.states = b.names('state');
            b.inputs = b.names('input');
            b.outputs = b.names('output');
            b.contacts = b.names('contact');
            b.contact_quantities = b.names('contact_quantity');
            b.bodies = b.names('body');
            b.force_sources = b.names('force_source');
            b.force_components = b.names('force_component');
        end

        function delete(b)
            try
                if ~isempty(b.sim), cagedyn_mex('free_sim', b.sim); end
                if ~isempty(b.model), cagedyn_mex('free_model', b.model); end
            catch
                % The gateway, which frees all that is left, may end before.
            end
        end

        function list = names(b, kind)
            list = cagedyn_mex('names', b.model, kind, 'name');
        end

        function list = units(b, kind)
            list = cagedyn_mex('names', b.model, kind, 'unit');
        end

        function list = descriptions(b, kind)
            list = cagedyn_mex('names', b.model, kind, 'description');
        end

        function lengths = geometry(b)
            % Lengths and counts of the bearing in m or 1, as a struct.
            list = b.names('geometry');
            for i = 1:numel(list)
                lengths.(list{i}) = cagedyn_mex('geometry', b.model, i);
            end
        end

        function t = time(b)
            t = cagedyn_mex('time', b.sim);
        end

        function x = state(b)
            x = cagedyn_mex('state', b.sim);
        end

        function set_state(b, t, x)
            cagedyn_mex('set_state', b.sim, t, x);
        end

        function reset(b)
            cagedyn_mex('reset', b.sim);
        end

        function advance_to(b, t)
            % To time t in s. Ctrl-C stops it after a step, and so does cancel; it can then go on.
            while ~cagedyn_mex('advance', b.sim, t, 0.2)
                drawnow;
            end
        end

        function cancel(b)
            % From a callback of a timer or a figure, which drawnow calls: ends the running advance_to, or else the next one, with
            % the error cagedyn:ERR_CANCELLED.
            cagedyn_mex('cancel', b.sim);
        end

        function saved = save(b)
            % Everything that its future depends on, for restore.
            saved = cagedyn_mex('save', b.sim);
        end

        function restore(b, saved)
            % Goes on from what save gave, with the same bits; of the same scene and preset, by the same build of the library.
            cagedyn_mex('restore', b.sim, saved);
        end

        function step(b, dt)
            b.advance_to(b.time() + dt);
        end

        function values = output_values(b)
            % All outputs at the present state, in the order of b.outputs.
            values = cagedyn_mex('outputs', b.sim);
        end

        function value = output(b, name)
            values = b.output_values();
            value = values(Cagedyn.place(b.outputs, name));
        end

        function values = outputs_at(b, t, x)
            % All outputs at any time and state.
            values = cagedyn_mex('outputs_at', b.sim, t, x);
        end

        function [t, values] = record(b, last, interval, list)
            % Outputs of these names every interval up to the last time: one row per record.
            places = cellfun(@(name) Cagedyn.place(b.outputs, name), list);
            t = (b.time():interval:last)';
            values = zeros(numel(t), numel(places));
            for i = 1:numel(t)
                b.advance_to(t(i));
                now = b.output_values();
                values(i, :) = now(places);
            end
        end

        function value = input(b, name)
            value = cagedyn_mex('input', b.sim, Cagedyn.place(b.inputs, name));
        end

        function set_input(b, name, value)
            cagedyn_mex('set_input', b.sim, Cagedyn.place(b.inputs, name), value);
        end

        function set_input_slope(b, name, value, slope)
            % The input goes on from the value with this slope per second. A ring is moved by its rate: the slope of 'inner_ring.vy' is its
            % acceleration.
            cagedyn_mex('set_input_slope', b.sim, Cagedyn.place(b.inputs, name), value, slope);
        end

        function release_input(b, name)
            cagedyn_mex('release_input', b.sim, Cagedyn.place(b.inputs, name));
        end

        function rate = derivative(b, t, x)
            % Right-hand side for ode15s and its kin.
            rate = cagedyn_mex('derivative', b.sim, t, x);
        end

        function matrix = jacobian(b, t, x)
            % Exact sparse Jacobian of derivative.
            matrix = cagedyn_mex('jacobian', b.sim, t, x, b.model);
        end

        function matrix = input_jacobian(b, t, x)
            % Exact derivatives of derivative over the inputs, one column per input.
            matrix = cagedyn_mex('input_jacobian', b.sim, t, x, b.model);
        end

        function [over_states, over_inputs] = output_jacobian(b, t, x)
            % Derivatives of the outputs over states and over inputs, one row per output.
            both = cagedyn_mex('output_jacobian', b.sim, t, x, b.model);
            over_states = both(:, 1:numel(x));
            over_inputs = both(:, numel(x) + 1:end);
        end

        function matrix = feedthrough_pattern(b)
            % Ones where an output (row) may change at once with an input (column).
            matrix = cagedyn_mex('feedthrough_pattern', b.model);
        end

        function values = contact_forces(b)
            % One row per contact, one column per contact quantity.
            values = cagedyn_mex('contact_forces', b.sim)';
        end

        function values = body_forces(b)
            % Bodies, sources, components.
            values = permute(cagedyn_mex('body_forces', b.sim), [3 2 1]);
        end

        function text = doubts(b)
            % Why the run does not keep what its preset promises, or why that cannot be known; empty if it does.
            text = cagedyn_mex('doubts', b.sim);
        end

        function text = report(b)
            text = cagedyn_mex('report', b.sim);
        end

        function counts = statistics(b)
            % Counts since creation or reset, as a struct.
            counts = cagedyn_mex('statistics', b.sim);
        end

        function counts = law_evaluations(b)
            % How often each force law was evaluated, as a struct.
            counts = cagedyn_mex('law_evaluations', b.sim);
        end

        function works = power_balance(b)
            % Works and gains of energy in J, and what is missing, as a struct.
            works = cagedyn_mex('power_balance', b.sim);
        end

        function branch = whirl(b, path, first, last)
            % Steady whirls of the scene without its gravity: whirl() finds one, whirl(PATH, FIRST, LAST) follows it over a number
            % of the scene, such as 'inner_ring.speed.constant', around folds. A struct: points has a column per quantity with a
            % row per point (parameter, whirl_speed in rad/s, eccentricity in m, lead, stable, ...); amplitudes of the waves of an
            % elastic cage in m and eigenvalues (1/s, plus i times rad/s) have a row per point; ending is 'range', 'length' or
            % 'lost', why says more.
            if nargin > 1
                branch = cagedyn_mex('whirl', b.model, path, first, last);
            else
                branch = cagedyn_mex('whirl', b.model);
            end
            for i = 1:numel(branch.quantities)
                branch.points.(branch.quantities{i}) = branch.values(i, :)';
            end
            branch.amplitudes = branch.amplitudes';
            branch.eigenvalues = complex(branch.rates, branch.frequencies).';
            branch = rmfield(branch, {'quantities', 'values', 'rates', 'frequencies'});
        end
    end

    methods (Static)
        function i = place(list, name)
            i = find(strcmp(list, name));
            if isempty(i)
                error('cagedyn:ERR_UNKNOWN_NAME', 'there is no ''%s''', name);
            end
        end
    end
end
