% A cage that tilts among balls, in MATLAB or Octave: how far, where it is and how fast it turns, and the contact angles of a ball.
% Needs matlab/ in the path with the compiled gateway; see matlab/build_cagedyn.m.
b = Cagedyn('scenes/angular_contact_70_cage.json');
names = {'cage.tilt', 'cage.eccentricity', 'cage.speed', 'ball[0].inner_angle', 'ball[0].outer_angle'};
[t, values] = b.record(20e-3, 5e-3, names);
for i = 1:numel(t)
    fprintf('%3.0f ms: cage tilts by %.3f mrad, is off by %.3f of its clearance, turns at %.2f rad/s; ball 0 at %.2f and %.2f deg\n', ...
            1e3 * t(i), 1e3 * values(i, 1), values(i, 2:3), 180 / pi * values(i, 4:5));
end
if isempty(b.doubts())
    fprintf('the run kept its power balance\n');
else
    fprintf('%s\n', b.doubts());
end
