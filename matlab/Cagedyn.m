classdef Cagedyn < handle
    % Dynamics of the cage, the rolling elements and the rings of a rolling bearing.
    %
    %   b = Cagedyn('scenes/nu2310.json');
    %   b.advance_to(0.01);
    %   b.output('cage.y_ratio')
    %
    % SI units, angles in rad. Names, units and meanings: b.states, b.inputs, b.outputs, b.contacts, b.contact_quantities,
    % b.bodies, b.force_sources, b.force_components; b.units('output'), b.descriptions('output'). Failures of the library are
    % errors with the identifier cagedyn:ERR_... . It needs the compiled gateway cagedyn_mex, see cagedyn_mex.c.

    properties (SetAccess = private)
        states, inputs, outputs, contacts, contact_quantities, bodies, force_sources, force_components
    end

    properties (Access = private)
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
            % To time t in s. Ctrl-C stops it after a step; it can then go on.
            while ~cagedyn_mex('advance', b.sim, t, 0.2)
                drawnow;
            end
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

        function values = contact_forces(b)
            % One row per contact, one column per contact quantity.
            values = cagedyn_mex('contact_forces', b.sim)';
        end

        function values = body_forces(b)
            % Bodies, sources, components.
            values = permute(cagedyn_mex('body_forces', b.sim), [3 2 1]);
        end

        function text = doubts(b)
            % Why the run does not keep what its preset promises; empty if it does.
            text = cagedyn_mex('doubts', b.sim);
        end

        function text = report(b)
            text = cagedyn_mex('report', b.sim);
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
