// A cylindrical roller bearing from C++: read a scene, run it, print where the cage is.
//
//   c++ -std=c++17 nu2310.cpp $(pkg-config --cflags --libs cagedyn) -o nu2310
//   ./nu2310 scenes/nu2310.json
#include <cstdio>
#include <cstdlib>

#include "cagedyn.hpp"

int main(int argc, char **argv)
try {
    cagedyn::Model model = cagedyn::Model::from_file(argc > 1 ? argv[1] : "scenes/nu2310.json");
    cagedyn::Sim sim(model);
    const auto y = model.outputs().find("cage.y_ratio"), z = model.outputs().find("cage.z_ratio");
    for (int i = 0; i <= 4; i++) {
        sim.advance_to(5e-3 * i);
        std::printf("%5.1f ms: cage centre (%.3f, %.3f) of the guide clearance\n", 5.0 * i, sim.output(y), sim.output(z));
    }
    std::printf("%s\n", sim.trusted() ? "the run kept its power balance" : cagedyn_error_message());
    return EXIT_SUCCESS;
} catch (const cagedyn::Error &error) {
    std::fprintf(stderr, "%s (%s)\n", error.what(), std::string(error.name()).c_str());
    return EXIT_FAILURE;
}
