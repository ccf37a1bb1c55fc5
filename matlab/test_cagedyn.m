function test_cagedyn(scene)
% Numbers, names, errors, and an integrator of MATLAB or Octave on derivative and sparse Jacobian.
b = Cagedyn(scene);
assert(numel(b.states) == 70 && strcmp(b.states{3}, 'cage.y'));
units = b.units('state');
assert(strcmp(units{3}, 'm') && numel(b.descriptions('output')) == numel(b.outputs));
lengths = b.geometry();
assert(lengths.element_radius == 7.5e-3);
b.advance_to(1e-3);
assert(b.time() == 1e-3);
x = b.state();
n = numel(x);
rate = b.derivative(1e-3, x);
matrix = b.jacobian(1e-3, x);
assert(issparse(matrix) && all(size(matrix) == [n n]) && nnz(matrix) < n * n / 3);
step = zeros(n, 1);
step(3) = 1e-9;
difference = (b.derivative(1e-3, x + step) - b.derivative(1e-3, x - step)) / 2e-9;
assert(norm(full(matrix(:, 3)) - difference) < 1e-4 * norm(difference));
assert(isequal(rate(1:29), x(30:58)));
assert(all(size(b.contact_forces()) == [numel(b.contacts), numel(b.contact_quantities)]));
assert(all(size(b.body_forces()) == [numel(b.bodies), numel(b.force_sources), 3]));
ours = b.output('cage.y_ratio');
values = b.outputs_at(1e-3, x);
assert(values(strcmp(b.outputs, 'cage.y')) == x(3));
b.set_input('load.z', -1000);
assert(b.input('load.z') == -1000);
b.release_input('load.z');
assert(b.input('load.z') == -4900);
assert(isempty(b.doubts()) && ~isempty(b.report()));
[t, record] = b.record(2e-3, 0.25e-3, {'cage.y_ratio', 'cage.z_ratio'});
assert(numel(t) == 5 && all(size(record) == [5 2]) && record(1, 1) == ours);
small = Cagedyn(scene, {'rollers.count=6', 'cage.guide=null'}, 'draft');
assert(numel(small.contacts) == 24);

fails(@() Cagedyn('{}'), 'cagedyn:ERR_BAD_JSON');
fails(@() Cagedyn(scene, {'rollers.size=3'}), 'cagedyn:ERR_BAD_JSON');
fails(@() b.advance_to(0), 'cagedyn:ERR_BAD_VALUE');
fails(@() b.set_state(0, [1 2 3]), 'cagedyn:ERR_WRONG_SIZE');
fails(@() b.derivative(0, nan(n, 1)), 'cagedyn:ERR_BAD_VALUE');
fails(@() b.output('wheel'), 'cagedyn:ERR_UNKNOWN_NAME');
fails(@() cagedyn_mex('time', 77), 'cagedyn:usage');
fails(@() cagedyn_mex('time', b), 'cagedyn:usage');
fails(@() cagedyn_mex('wheel', 1), 'cagedyn:usage');
fails(@() cagedyn_mex(), 'cagedyn:usage');
disp('all checks passed');
end

function fails(call, id)
try
    call();
catch e
    assert(strcmp(e.identifier, id), '%s instead of %s: %s', e.identifier, id, e.message);
    return;
end
error('this should have failed with %s', id);
end
