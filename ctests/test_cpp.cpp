// The C++ interface, with and without exceptions: the numbers of the C interface, ownership, errors.
#include "cagedyn.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <utility>
#if defined(__cpp_lib_span) || __cplusplus >= 202002L
#include <span>
#endif

#include "check.hpp"

using namespace cagedyn;

static_assert(!std::is_copy_constructible_v<Model> && std::is_nothrow_move_constructible_v<Model>);
static_assert(!std::is_copy_constructible_v<Sim> && std::is_nothrow_move_constructible_v<Sim>);
static_assert(!std::is_copy_assignable_v<Sim> && std::is_nothrow_move_assignable_v<Sim>);
static_assert(!std::is_copy_constructible_v<Batch> && std::is_move_constructible_v<Batch>);

static void check_model(const Model &model)
{
    CHECK(model && version() == cagedyn_version());
    CHECK(model.states().size() == 70 && model.position_count() + model.velocity_count() == 70);
    CHECK(model.states().name(2) == "cage.y" && model.states().find("cage.y") == 2);
    CHECK(model.states().unit(2) == "m" && !model.states().description(2).empty());
    CHECK(model.outputs().has("cage.y_ratio") && !model.outputs().has("wheel"));
    CHECK(model.bodies().names().size() == 15 && model.bodies().names()[1] == "inner_ring");
    CHECK(model.contacts().size() == 48 && model.inputs().size() == 3);
    CHECK(model.geometry("element_radius") == 7.5e-3);
    CHECK(model.scene_json().find("cagedyn.scene/1") != std::string_view::npos);
    CHECK(model.warnings().empty());
    Model small = Model::from_json(std::string(model.scene_json()), "rollers.count=6");
    CHECK(small.contacts().size() == 24);
    JacobianPattern pattern = model.jacobian_pattern();
    CHECK(pattern.column_starts.size() == 71 && pattern.rows.size() == std::size_t(pattern.column_starts[70]));
}

static void check_sim(const Model &model)
{
    Sim sim(model), other(model, Preset::engineering);
    cagedyn_sim *plain = cagedyn_sim_new(model.get());
    sim.advance_to(1e-3);
    CHECK(cagedyn_sim_advance_to(plain, 1e-3) == CAGEDYN_OK);
    std::vector<double> state = sim.state(), expected(state.size());
    CHECK(cagedyn_sim_get_state(plain, expected.data(), 70) == CAGEDYN_OK);
    CHECK(state == expected && sim.time() == 1e-3);
    CHECK(sim.outputs()[0] == sim.output(0) && sim.outputs().size() == std::size_t(model.outputs().size()));
    CHECK(sim.contact_forces().size() == std::size_t(48 * model.contact_quantities().size()));
    CHECK(model.line_load_quantities().name(2) == "line_load" && sim.line_loads(0).empty());
    CHECK(sim.body_forces().size() == std::size_t(15 * model.force_sources().size() * 3));

    std::array<double, 70> rate{};
    double rates[70];
    sim.derivative(1e-3, state, rate);
    sim.derivative(1e-3, state, rates);
    CHECK(std::memcmp(rate.data(), rates, sizeof rates) == 0);
    std::vector<double> accelerations = sim.accelerations();
    CHECK(std::memcmp(rate.data() + 29, accelerations.data(), 41 * sizeof(double)) == 0);
    CHECK(sim.energies_at(1e-3, state).kinetic > 0.0);
    std::vector<double> values(model.jacobian_pattern().rows.size());
    sim.sparse_jacobian(1e-3, state, values);
    sim.linearize(1e-3, state);
    sim.factorize(1e-6);
    sim.solve(rate);
#ifdef __cpp_lib_span
    std::span<const double> view(state);
    sim.derivative(1e-3, view, std::span<double>(rates));
#endif

    // Inputs, saving, moving.
    std::int64_t speed = model.inputs().find("inner_ring.speed");
    double was = sim.input(speed);
    std::vector<double> saved = sim.save();
    sim.set_input(speed, was * 1.01);
    sim.step(1e-4);
    CHECK(sim.input(speed) == was * 1.01);
    sim.restore(saved);
    CHECK(sim.input(speed) == was && sim.state() == state);
    Sim moved = std::move(sim);
    CHECK(!sim && moved.state() == state);
    other = std::move(moved);
    CHECK(!moved && other.state() == state && other.trusted());
    CHECK(!other.report().empty() && other.statistics()[0] > 0.0 && other.power_balance().size() > 10);
    other.canceller().cancel();
    CHECK(cagedyn_sim_step(other.get(), 1e-4) == CAGEDYN_ERR_CANCELLED);
    other.reset();
    CHECK(other.time() == 0.0);
    cagedyn_sim_free(plain);
}

static void check_batch(const Model &model)
{
    Batch batch;
    for (int i = 0; i < 3; i++) CHECK(batch.add(Sim(model)) == i);
    Monitor monitor = batch.monitor();
    CHECK(batch.size() == 3 && batch.advance_to(1e-3) && monitor.progress().arrived == 3);
    Sim alone(model);
    alone.advance_to(1e-3);
    CHECK(batch[2].state() == alone.state());
    batch[1].set_wall_time_limit(0.0);
    CHECK(!batch.advance_to(2e-3, 2));
    CHECK(batch.status(1) == CAGEDYN_ERR_OUT_OF_TIME && !batch.message(1).empty() && batch.message(0).empty());
    for (std::string_view name : model.inputs().names()) CHECK(model.inputs().has(name));
    Batch taken = std::move(batch);
    CHECK(taken.size() == 3 && taken[0].time() == 2e-3);
}

#ifdef CAGEDYN_NO_EXCEPTIONS
static void check_errors(const Model &model)
{
    CHECK(!Model::from_json("{}") && last_status() == CAGEDYN_ERR_BAD_JSON && !last_message().empty());
    Model none;
    CHECK(!Sim(none));
    Sim sim(model);
    sim.step(-1.0);
    CHECK(last_status() == CAGEDYN_ERR_BAD_VALUE);
    CHECK(sim.time() == 0.0 && last_status() == CAGEDYN_OK);
    CHECK(model.outputs().find("wheel") == CAGEDYN_ERR_UNKNOWN_NAME);
    sim.output(model.outputs().find("cage.zratio"));
    CHECK(last_message().find("'cage.zratio', the nearest is 'cage.z_ratio'") != std::string_view::npos);
}
#else
static void check_errors(const Model &model)
{
    Sim sim(model);
    std::vector<double> state = sim.state();
    double few[3];
    CHECK(status_of([] { Model::from_json("{}"); }) == CAGEDYN_ERR_BAD_JSON);
    CHECK(status_of([] { Model::from_file("no such file"); }) == CAGEDYN_ERR_FILE);
    CHECK(status_of([] { Sim none{Model()}; }) == CAGEDYN_ERR_NULL_ARGUMENT);
    CHECK(status_of([&] { sim.step(-1.0); }) == CAGEDYN_ERR_BAD_VALUE);
    CHECK(status_of([&] { sim.derivative(0.0, state, few); }) == CAGEDYN_ERR_WRONG_SIZE);
    CHECK(status_of([&] { sim.outputs(few); }) == CAGEDYN_ERR_WRONG_SIZE);
    CHECK(status_of([&] { model.outputs().find("wheel"); }) == CAGEDYN_ERR_UNKNOWN_NAME);
    try {
        model.outputs().find("cage.zratio");
    } catch (const Error &error) {
        CHECK(std::string_view(error.what()).find("'cage.zratio', the nearest is 'cage.z_ratio'") != std::string_view::npos);
    }
    CHECK(status_of([&] { model.states().name(70); }) == CAGEDYN_ERR_BAD_INDEX);
    CHECK(status_of([&] { model.geometry("wheel"); }) == CAGEDYN_ERR_UNKNOWN_NAME);
    CHECK(status_of([&] { sim.step(1e-5); }) == CAGEDYN_OK);
    Batch batch;
    batch.add(Sim(model));
    CHECK(status_of([&] { batch.advance_to(2e-3, -1); }) == CAGEDYN_ERR_BAD_VALUE);
    CHECK(status_of([&] { batch.advance_to(-1.0); }) == CAGEDYN_ERR_BAD_VALUE);
    CHECK(status_of([&] { batch.status(9); }) == CAGEDYN_ERR_BAD_INDEX && batch.status(0) == CAGEDYN_OK);
}
#endif

int main(int argc, char **argv)
{
    Model model(load_model(argc, argv));
    check_model(model);
    check_sim(model);
    check_batch(model);
    check_errors(model);
    return failures > 0;
}
