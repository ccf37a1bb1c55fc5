// Balls that move in space, from C++: stiffness for a rotor code, then a run with a load that a host changes, and what the balls do.
//
//   c++ -std=c++17 ball_bearing.cpp $(pkg-config --cflags --libs cagedyn) -o ball_bearing
//   ./ball_bearing scenes/angular_contact_70.json
#include <cstdio>
#include <cstdlib>

#include "cagedyn.hpp"
#include "cagedyn_analysis.hpp"

int main(int argc, char **argv)
try {
    cagedyn::Model model = cagedyn::Model::from_file(argc > 1 ? argv[1] : "scenes/angular_contact_70.json");
    // Friction of the balls themselves decides where they spin.
    const cagedyn::Equilibrium found(model, cagedyn::RaceControl::friction);
    const auto at = found.displacement(), stiffness = found.stiffness();
    const std::size_t next = at.size() + 1;
    std::printf("equilibrium: x = %.3f um; stiffness along x, y, z: %.2f, %.2f, %.2f N/um\n", 1e6 * at[0],
                1e-6 * stiffness[0], 1e-6 * stiffness[next], 1e-6 * stiffness[2 * next]);
    cagedyn::Sim sim(model);
    const auto output = [&](const char *name) { return sim.output(model.outputs().find(name)); };
    const double degree = 57.29577951308232;
    for (int step = 0; step <= 3; step++) {
        sim.advance_to(4e-3 * step);
        std::printf("%4.1f ms: contact angles %.2f and %.2f deg, %.2f N, orbit %.4f of rolling, x = %.3f um\n", 4.0 * step,
                    degree * output("ball[0].inner_angle"), degree * output("ball[0].outer_angle"),
                    output("ball[0].inner_force"), output("balls.orbit_ratio"), 1e6 * output("inner_ring.x"));
        // From here on the machine presses harder.
        sim.set_input(model.inputs().find("load.x"), 900.0);
    }
    std::printf("%s\n", sim.trusted() ? "the run kept its power balance" : cagedyn_error_message());
    return EXIT_SUCCESS;
} catch (const cagedyn::Error &error) {
    std::fprintf(stderr, "%s (%s)\n", error.what(), std::string(error.name()).c_str());
    return EXIT_FAILURE;
}
