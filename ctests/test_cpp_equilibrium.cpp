// Equilibrium from C++, with and without exceptions: the numbers of the C interface, errors. The scene is that of an angular contact
// bearing.
#include "cagedyn_analysis.hpp"

#include <cmath>
#include <cstdio>

#include "check.hpp"

using namespace cagedyn;

static_assert(!std::is_copy_constructible_v<Equilibrium> && std::is_nothrow_move_constructible_v<Equilibrium>);

static std::size_t place(const std::vector<std::string_view> &names, std::string_view name)
{
    std::size_t i = 0;
    while (i < names.size() && names[i] != name) i++;
    return i;
}

int main(int argc, char **argv)
{
    Model model(load_model(argc, argv));
    Equilibrium still(model);
    CHECK(still && still.coordinates().size() == 5 && still.coordinate_units()[4] == "rad");
    CHECK(std::fabs(still.displacement()[0] - 36.1e-6) < 0.05e-6 && std::fabs(still.load()[0] - 17800.0) < 1e-6);
    std::vector<double> k = still.stiffness();
    CHECK(k.size() == 25 && k[0] > 7e8 && std::fabs(k[6] - k[12]) < 1e-9 * k[0]);
    CHECK(still.elements() == 16 && still.contacts().size() == 32 && still.contacts()[1] == "ball[0].inner_raceway");
    CHECK(still.element(15).size() == still.element_quantities().size() && still.warnings().empty());
    CHECK(still.life_quantities().empty() && still.life_units().empty() && still.life().empty());
    CHECK(still.contact_units().size() == still.contact_quantities().size());
    CHECK(still.element_units()[place(still.element_quantities(), "orbit_speed")] == "rad/s");
    CHECK(status_of([&] { still.contact(32); }) == CAGEDYN_ERR_BAD_INDEX);
    CHECK(status_of([] { Equilibrium{Model()}; }) == CAGEDYN_ERR_NULL_ARGUMENT);

    Model fast = Model::from_json(
        std::string(model.scene_json()),
        "inner_ring.speed.constant=1047.1975511965977\ninner_ring.motion.space.load.x.constant=22250");
    const std::size_t angle = place(still.contact_quantities(), "contact_angle");
    auto degrees = [&](RaceControl control) { return 57.29578 * Equilibrium(fast, control).contact(1)[angle]; };
    CHECK(std::fabs(degrees(RaceControl::outer) - 48.74) < 0.01);
    CHECK(std::fabs(degrees(RaceControl::none) - 47.75) < 0.01);
    CHECK(degrees(RaceControl::inner) < 46.0);
    CHECK(std::fabs(degrees(RaceControl::friction) - 47.90) < 0.05);
    Equilibrium taken = std::move(still);
    CHECK(!still && taken);
    return failures > 0;
}
