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
assert(all(size(b.input_jacobian(1e-3, x)) == [n, numel(b.inputs)]));
[over_states, over_inputs] = b.output_jacobian(1e-3, x);
assert(abs(over_states(strcmp(b.outputs, 'cage.y'), 3) - 1) < 1e-6 && size(over_inputs, 2) == numel(b.inputs));
assert(all(size(b.feedthrough_pattern()) == size(over_inputs)) && all(all(b.feedthrough_pattern() | over_inputs == 0)));
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

% Cancelling, saving, and what the run says of itself.
b.cancel();
fails(@() b.advance_to(3e-3), 'cagedyn:ERR_CANCELLED');
saved = b.save();
b.advance_to(3e-3);
later = b.state();
steps = b.statistics().steps;
b.restore(saved);
assert(b.time() < 3e-3 && b.statistics().steps < steps);
b.advance_to(3e-3);
assert(isequal(b.state(), later) && b.statistics().steps == steps && steps > 100);
assert(b.law_evaluations().outer_raceway > 100 && abs(b.power_balance().relative_residual) < 1e-3);
fails(@() small.restore(saved), 'cagedyn:ERR_WRONG_SIZE');
fails(@() Cagedyn(scene, {'inner_ring.motion.free.load.z.constant=-1'}).restore(saved), 'cagedyn:ERR_BAD_SNAPSHOT');

% A batch: results as alone, failures of some, simulations that outlive it.
loads = cellfun(@(z) {sprintf('inner_ring.motion.free.load.z.constant=%d', z)}, {-4000, -6000, -8000}, 'UniformOutput', false);
runs = cellfun(@(change) Cagedyn(scene, change), loads, 'UniformOutput', false);
alone = Cagedyn(scene, loads{2});
alone.advance_to(1e-3);
batch = CagedynBatch(runs);
batch.advance_to(1e-3);
assert(isequal(runs{2}.state(), alone.state()) && runs{3}.time() == 1e-3);
runs{1}.advance_to(2e-3);
failures = batch.advance_to(1.5e-3, 2);
assert(~isempty(strfind(failures{1}, 'before')) && isempty(failures{2}) && runs{2}.time() == 1.5e-3);
fails(@() batch.advance_to(1.6e-3), 'cagedyn:ERR_BAD_VALUE');
fails(@() batch.advance_to(nan), 'cagedyn:ERR_BAD_VALUE');
fails(@() batch.advance_to(3e-3, -1), 'cagedyn:ERR_BAD_VALUE');
batch.cancel();
fails(@() batch.advance_to(3e-3), 'cagedyn:ERR_CANCELLED');
batch.advance_to(3e-3);
fails(@() CagedynBatch({Cagedyn(scene), runs{1}}), 'cagedyn:ERR_BAD_VALUE');
fails(@() cagedyn_mex('batch', [alone.sim, 99]), 'cagedyn:usage');
% Long enough for several looks at Ctrl-C.
alone.advance_to(0.1);
batch.advance_to(0.1);
assert(isequal(runs{2}.state(), alone.state()));
clear batch;
runs{2}.advance_to(0.101);
assert(runs{2}.time() == 0.101 && runs{3}.time() == 0.1);
clear runs;

% Steady whirl and heat.
guide = Cagedyn(beside(scene, 'grease_guide.json'));
branch = guide.whirl();
assert(abs(branch.points.whirl_speed + 1962) < 1 && branch.points.stable == 1 && isempty(branch.amplitudes));
assert(isequal(size(branch.eigenvalues), [1 5]) && real(branch.eigenvalues(1)) == branch.points.leading_rate);
branch = guide.whirl('inner_ring.speed.constant', 314.16, 450);
assert(strcmp(branch.ending, 'range') && isempty(branch.why) && branch.points.parameter(end) == 450);
assert(all(diff(branch.points.whirl_speed) < 0) && size(branch.eigenvalues, 1) == numel(branch.points.lead));
fails(@() guide.whirl('inner_ring.sped', 1, 2), 'cagedyn:ERR_BAD_JSON');
fails(@() CagedynHeat(guide), 'cagedyn:ERR_BAD_SCENE');
h = CagedynHeat(Cagedyn(beside(scene, 'grease_guide_heat.json')));
film = strcmp(h.lumps, 'film');
fails(@() h.into_lumps(), 'cagedyn:ERR_BAD_STATE');
start = h.temperatures();
h.step(10);
now = h.temperatures();
assert(now(film) > start(film));
h.settle();
now = h.temperatures();
assert(abs(now(film) - 330.95) < 0.3 && h.quantities().whirl_speed < 0);
to_surroundings = sum(h.flows() .* ((h.links(:, 2) == 0) - (h.links(:, 1) == 0)));
assert(abs(to_surroundings - sum(h.into_lumps())) < 0.1 && sum(h.of_sources()) > 0);
assert(numel(h.sources) == numel(h.of_sources()));
now(film) = 300;
h.set_temperatures(now);
assert(isequal(h.temperatures(), now));
now(film) = 2000;
fails(@() h.set_temperatures(now), 'cagedyn:ERR_BAD_VALUE');

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

function path = beside(scene, name)
path = fullfile(fileparts(scene), name);
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
