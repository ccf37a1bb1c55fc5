classdef CagedynHeat < handle
    % Temperatures of a bearing whose scene has heat.
    %
    %   h = CagedynHeat(Cagedyn('scenes/grease_guide_heat.json'));
    %   h.settle();
    %   h.temperatures()

    properties (SetAccess = private)
        % Names of the lumps, and of the powers of the motion that warm them.
        lumps, sources
        % Numbers of the two lumps that each link joins, one row per link; 0 stands for the surroundings.
        links
    end

    properties (Access = private)
        heat
    end

    methods
        function h = CagedynHeat(bearing)
            % Of a Cagedyn.
            h.heat = cagedyn_mex('heat', bearing.model);
            h.lumps = cagedyn_mex('heat_lumps', h.heat);
            h.sources = cagedyn_mex('heat_sources', h.heat);
            h.links = cagedyn_mex('heat_links', h.heat);
        end

        function delete(h)
            try
                if ~isempty(h.heat), cagedyn_mex('free_heat', h.heat); end
            catch
                % As in Cagedyn.
            end
        end

        function settle(h)
            % Finds the temperatures at which the bearing stays, from bursts of motion. On failure nothing changes.
            cagedyn_mex('heat_settle', h.heat);
        end

        function step(h, duration)
            % Warms up for a duration in s with the heat of one burst of motion: the longer, the more roughly.
            cagedyn_mex('heat_step', h.heat, duration);
        end

        function kelvin = temperatures(h)
            % Temperature of each lump, K.
            kelvin = cagedyn_mex('heat_temperatures', h.heat);
        end

        function set_temperatures(h, kelvin)
            cagedyn_mex('heat_set_temperatures', h.heat, kelvin);
        end

        function watts = into_lumps(h)
            % Heat that went into each lump in the last burst of motion, W.
            watts = cagedyn_mex('heat_into_lumps', h.heat);
        end

        function watts = flows(h)
            % Heat through each of the links after the last burst, from its first lump to its second, W.
            watts = cagedyn_mex('heat_flows', h.heat);
        end

        function watts = of_sources(h)
            % Heat of each of the sources in the last burst, W.
            watts = cagedyn_mex('heat_of_sources', h.heat);
        end

        function all = quantities(h)
            % What else the last burst came to, as a struct: viscosity (Pa s), radial_clearance (m), whirl_speed (rad/s), heat in W,
            % standard_error (K).
            all = cagedyn_mex('heat_quantities', h.heat);
        end
    end
end
