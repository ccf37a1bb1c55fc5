% A cylindrical roller bearing in MATLAB or Octave: by the library's own method, and by ode15s with derivative and sparse Jacobian.
% Needs matlab/ in the path with the compiled gateway; see matlab/build_cagedyn.m.
scene = getenv('CAGEDYN_SCENE');
if isempty(scene)
    scene = 'scenes/nu2310.json';
end
b = Cagedyn(scene);
start = b.state();
[t, places] = b.record(0.02, 5e-3, {'cage.y_ratio', 'cage.z_ratio'});
for i = 1:numel(t)
    fprintf('%5.1f ms: cage centre (%.3f, %.3f) of the guide clearance\n', 1e3 * t(i), places(i, 1), places(i, 2));
end
if isempty(b.doubts())
    fprintf('the run kept its power balance\n');
else
    fprintf('%s\n', b.doubts());
end

% The same start with an integrator of the host.
if exist('ode15s')
    lengths = b.geometry();
    scale = lengths.guide_clearance * ones(numel(start), 1);
    scale(~cellfun(@isempty, strfind(b.units('state'), '/s'))) = scale(1) * 1e4;
    angles = ~cellfun(@isempty, strfind(b.units('state'), 'rad'));
    scale(angles) = scale(angles) / lengths.pitch_radius;
    options = odeset('RelTol', 1e-6, 'AbsTol', 1e-5 * scale, 'Jacobian', @(t, x) b.jacobian(t, x), 'MaxStep', 1e-5);
    [t, x] = ode15s(@(t, x) b.derivative(t, x), [0 1e-3], start, options);
    b.reset();
    b.advance_to(1e-3);
    ours = b.state();
    difference = norm(x(end, 3:4)' - ours(3:4)) / lengths.guide_clearance;
    fprintf('ode15s after 1 ms: within %.0e of the clearance\n', 10 ^ ceil(log10(difference)));
end
