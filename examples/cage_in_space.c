/* A cage that tilts among balls: how far, where it is and how fast it turns, and the contact angles of a ball.
 *
 *   cc -std=c99 cage_in_space.c $(pkg-config --cflags --libs cagedyn) -o cage_in_space
 *   ./cage_in_space scenes/angular_contact_70_cage.json
 */
#include "example.h"

int main(int argc, char **argv)
{
    cagedyn_model *model = model_of(argc, argv);
    cagedyn_sim *sim = cagedyn_sim_new(model);
    if (sim == NULL) fail("simulation");
    const char *const names[] = {"cage.tilt", "cage.eccentricity", "cage.speed", "ball[0].inner_angle", "ball[0].outer_angle"};
    int64_t outputs = cagedyn_model_output_count(model), place[5];
    for (int i = 0; i < 5; i++) {
        place[i] = cagedyn_model_find_output(model, names[i]);
        if (place[i] < 0) fail(names[i]);
    }
    double *values = array(outputs);
    for (int step = 0; step <= 4; step++) {
        if (cagedyn_sim_advance_to(sim, 5e-3 * step) != CAGEDYN_OK) fail("advance");
        if (cagedyn_sim_get_outputs(sim, values, outputs) != CAGEDYN_OK) fail("outputs");
        printf("%3.0f ms: cage tilts by %.3f mrad, is off by %.3f of its clearance, turns at %.2f rad/s; ball 0 at %.2f and %.2f deg\n",
               5.0 * step, 1e3 * values[place[0]], values[place[1]], values[place[2]], 57.29577951308232 * values[place[3]],
               57.29577951308232 * values[place[4]]);
    }
    printf("%s\n", cagedyn_sim_trust(sim) == CAGEDYN_OK ? "the run kept its power balance" : cagedyn_error_message());
    free(values);
    cagedyn_sim_free(sim);
    cagedyn_model_free(model);
    return EXIT_SUCCESS;
}
