// A cage that tilts among balls, from C++: how far, where it is and how fast it turns, and the contact angles of a ball.
//
//   c++ -std=c++17 cage_in_space.cpp $(pkg-config --cflags --libs cagedyn) -o cage_in_space
//   ./cage_in_space scenes/angular_contact_70_cage.json
#include <cstdio>
#include <cstdlib>

#include "cagedyn.hpp"

int main(int argc, char **argv)
try {
    cagedyn::Model model = cagedyn::Model::from_file(argc > 1 ? argv[1] : "scenes/angular_contact_70_cage.json");
    cagedyn::Sim sim(model);
    const auto output = [&](const char *name) { return sim.output(model.outputs().find(name)); };
    const double degree = 57.29577951308232;
    for (int step = 0; step <= 4; step++) {
        sim.advance_to(5e-3 * step);
        std::printf(
            "%3.0f ms: cage tilts by %.3f mrad, is off by %.3f of its clearance, turns at %.2f rad/s; ball 0 at %.2f and %.2f deg\n",
            5.0 * step, 1e3 * output("cage.tilt"), output("cage.eccentricity"), output("cage.speed"),
            degree * output("ball[0].inner_angle"), degree * output("ball[0].outer_angle"));
    }
    std::printf("%s\n", sim.trusted() ? "the run kept its power balance" : cagedyn_error_message());
    return EXIT_SUCCESS;
} catch (const cagedyn::Error &error) {
    std::fprintf(stderr, "%s (%s)\n", error.what(), std::string(error.name()).c_str());
    return EXIT_FAILURE;
}
