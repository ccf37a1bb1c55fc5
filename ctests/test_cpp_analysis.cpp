// Whirl, heat and motion from C++, with and without exceptions: the numbers of the C interface, errors. The scene is that of a warm
// greased guide; a second argument asks for what takes minutes under Valgrind, too.
#include "cagedyn_analysis.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "check.hpp"

using namespace cagedyn;

static_assert(!std::is_copy_constructible_v<WhirlBranch> && std::is_nothrow_move_constructible_v<WhirlBranch>);
static_assert(!std::is_copy_constructible_v<HeatBalance> && std::is_nothrow_move_assignable_v<HeatBalance>);

static void check_whirl(const Model &warm, bool all)
{
    Model model = Model::from_json(
        std::string(warm.scene_json()),
        "heat=null\nlubricant.viscosity={\"constant\":0.09}\n"
        "cage.elastic_ring={\"modes\":4,\"neutral_radius\":0.045081,\"stiffness\":{\"bending\":0.2572},\"damping\":0.03}");
    CHECK(bool(model));
    Model rigid = Model::from_json(std::string(model.scene_json()), "cage.elastic_ring=null");
    WhirlBranch one = WhirlBranch::steady(rigid);
    CHECK(one && one.size() == 1 && one.end() == "range" && one.why().empty() && one.amplitudes(0).empty());
    WhirlBranch::Point point = one.point(0);
    CHECK(point.whirl_speed < 0.0 && point.eccentricity > 0.0 && point.arcs >= 1 && point.stable && !point.fold);
    std::vector<WhirlBranch::Eigenvalue> values = one.eigenvalues(0);
    CHECK(values.size() == 5 && values[0].rate == point.leading_rate && values[0].rate >= values[1].rate);
    CHECK(status_of([&] { one.point(1); }) == CAGEDYN_ERR_BAD_INDEX);
    CHECK(status_of([&] { one.eigenvalues(1); }) == CAGEDYN_ERR_BAD_INDEX);

    WhirlBranch branch = WhirlBranch::follow(rigid, "inner_ring.speed.constant", 314.16, 400.0);
    CHECK(branch.size() > 2 && branch.point(branch.size() - 1).parameter == 400.0);
    WhirlBranch taken = std::move(branch);
    CHECK(!branch && taken);
    CHECK(status_of([&] { WhirlBranch::follow(rigid, "wheel", 1.0, 2.0); }) == CAGEDYN_ERR_BAD_JSON);
    CHECK(status_of([] { WhirlBranch::steady(Model()); }) == CAGEDYN_ERR_NULL_ARGUMENT);

    Watch watch;
    watch.cancel();
    CHECK(status_of([&] { WhirlBranch::steady(rigid, watch); }) == CAGEDYN_ERR_CANCELLED);
    WhirlBranch short_one = WhirlBranch::follow(rigid, "inner_ring.speed.constant", 314.16, 330.0, watch);
    CHECK(short_one.status() == CAGEDYN_OK && watch.progress().share == 1.0);
    CHECK(watch.progress().found == static_cast<double>(short_one.size()));
    watch.set_wall_time_limit(0.0);
    CHECK(status_of([&] { WhirlBranch::steady(rigid, watch); }) == CAGEDYN_ERR_OUT_OF_TIME);
    if (all) CHECK(WhirlBranch::steady(model).amplitudes(0).size() == 3);
}

static void check_heat(const Model &model, bool all)
{
    HeatBalance heat(model);
    Watch watch;
    watch.cancel();
    CHECK(status_of([&] { heat.settle(watch); }) == CAGEDYN_ERR_CANCELLED);
    watch.cancel();
    CHECK(status_of([&] { heat.step(10.0, watch); }) == CAGEDYN_ERR_CANCELLED);
    std::vector<std::string_view> lumps = heat.lumps();
    std::size_t film = 0;
    while (film < lumps.size() && lumps[film] != "film") film++;
    CHECK(heat && lumps.size() == 6 && film < 6);
    CHECK(status_of([&] { heat.flows(); }) == CAGEDYN_ERR_BAD_STATE);
    std::vector<double> start = heat.temperatures();
    heat.step(10.0);
    CHECK(heat.temperatures()[film] > start[film]);
    if (all) {
        heat.settle();
        CHECK(std::fabs(heat.temperatures()[film] - 330.95) < 0.3);
    }

    // What goes into the lumps leaves for the surroundings once they are steady.
    double in = 0.0, out = 0.0, of_motion = 0.0;
    for (double watt : heat.into_lumps()) in += watt;
    std::vector<HeatBalance::Link> links = heat.links();
    std::vector<double> flows = heat.flows(), powers = heat.source_heat();
    for (std::size_t i = 0; i < links.size(); i++) {
        if (links[i].second == -1) out += flows[i];
        if (links[i].first == -1) out -= flows[i];
    }
    for (double watt : powers) of_motion += watt;
    CHECK(links.size() == flows.size() && in > 1.0 && (!all || std::fabs(out - in) < 0.1));
    CHECK(heat.sources().size() == powers.size() && of_motion > 0.0 && of_motion < in);
    HeatBalance::Quantities x = heat.quantities();
    CHECK(x.viscosity > 0.0 && std::isnan(x.radial_clearance) && x.whirl_speed < 0.0 && x.bursts >= (all ? 3.0 : 1.0));

    CHECK(status_of([&] { heat.step(-1.0); }) == CAGEDYN_ERR_BAD_VALUE);
    CHECK(status_of([&] { heat.set_temperatures(std::array<double, 2>{300.0, 300.0}); }) == CAGEDYN_ERR_WRONG_SIZE);
    heat.set_temperatures(start);
    CHECK(heat.temperatures() == start);
    CHECK(status_of([] { HeatBalance none{Model()}; }) == CAGEDYN_ERR_NULL_ARGUMENT);
}

static void check_motion()
{
    std::vector<double> t, y, z, whirl(1000, -2000.0), cage(1000, 140.0);
    for (int i = 0; i < 1000; i++) {
        t.push_back(1e-4 * i);
        y.push_back(1e-4 * std::cos(-2000.0 * t.back()));
        z.push_back(1e-4 * std::sin(-2000.0 * t.back()));
    }
    Motion motion = cage_motion({t, y, z, whirl, cage}, 2e-4, 0.05);
    CHECK(motion.kind == MotionKind::backward_whirl && motion.mean_whirl_speed == -2000.0);
    CHECK(std::fabs(motion.mean_radius - 1e-4) < 1e-12 && motion.settling_time == 0.0);
    CHECK(motion.backward_share == 1.0 && !motion.intermittent);
    z.pop_back();
    CHECK(status_of([&] { cage_motion({t, y, z, whirl, cage}, 2e-4, 0.05); }) == CAGEDYN_ERR_WRONG_SIZE);

    const double angles[] = {0.1, 0.2, 3.2}, values[] = {1.0, -3.0, 5.0};
    OverOrbit orbit = over_orbit(angles, values, 2);
    CHECK(orbit.mean.size() == 2 && orbit.mean[0] == -1.0 && orbit.peak[0] == 3.0 && orbit.positive_share[1] == 1.0);
    CHECK(status_of([&] { over_orbit(angles, Input(values, 2), 2); }) == CAGEDYN_ERR_WRONG_SIZE);
    for (std::int64_t sectors : {std::int64_t{0}, std::int64_t{-1}, INT64_MAX})
        CHECK(status_of([&] { over_orbit(angles, values, sectors); }) == CAGEDYN_ERR_BAD_VALUE);
}

int main(int argc, char **argv)
{
    Model model(load_model(argc, argv));
    check_whirl(model, argc > 2);
    check_heat(model, argc > 2);
    check_motion();
    return failures > 0;
}
