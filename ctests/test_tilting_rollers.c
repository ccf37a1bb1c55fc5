/* Rollers beside a ring that tilts, in C: their equilibrium, and that there is no motion over time. The scene is that of the NU2310. */
#include "check.h"

#include <math.h>

static const char *const tilted =
    "inner_ring.motion={\"space\": {\"y\": \"free\", \"z\": \"free\", \"tilt_y\": {\"held\": 1e-3},"
    " \"tilt_z\": {\"held\": 3e-4}, \"load\": {\"z\": {\"constant\": -4900}}}}";

int main(int argc, char **argv)
{
    cagedyn_model *plane = load_model(argc, argv);
    cagedyn_model *model = cagedyn_model_from_json_with(cagedyn_model_scene_json(plane), tilted);
    CHECK(model != NULL);
    cagedyn_equilibrium *found = cagedyn_equilibrium_find(model, NULL);
    CHECK(found != NULL && cagedyn_equilibrium_coordinate_count(found) == 5);
    double x[5], load[5], values[8];
    CHECK(cagedyn_equilibrium_displacement(found, x, 5) == CAGEDYN_OK);
    CHECK(cagedyn_equilibrium_load(found, load, 5) == CAGEDYN_OK);
    CHECK(fabs(x[2] + 27.316e-6) < 2e-9 && fabs(load[3] - 24.91) < 0.01);
    CHECK(cagedyn_equilibrium_contact_quantity_count(found) == 8);
    CHECK(strcmp(cagedyn_equilibrium_contact_name(found, 19), "roller[9].inner_raceway") == 0);
    CHECK(strcmp(cagedyn_equilibrium_contact_quantity_name(found, 3), "largest_line_load") == 0);
    CHECK(strcmp(cagedyn_equilibrium_contact_quantity_unit(found, 3), "N/m") == 0);
    CHECK(cagedyn_equilibrium_contact(found, 19, values, 8) == CAGEDYN_OK);
    CHECK(fabs(values[0] - 2469.0) < 0.2 && values[3] > 1.5 * values[0] / 20.4e-3);

    /* Its reference life: turns, time and the load of ISO 281 among others. */
    const int64_t count = cagedyn_equilibrium_life_quantity_count(found);
    CHECK(count == 8 && strcmp(cagedyn_equilibrium_life_quantity_name(found, 2), "reference_load") == 0);
    CHECK(strcmp(cagedyn_equilibrium_life_quantity_unit(found, 1), "s") == 0);
    CHECK(cagedyn_equilibrium_life(found, values, 7) == CAGEDYN_ERR_WRONG_SIZE);
    CHECK(cagedyn_equilibrium_life(found, values, count) == CAGEDYN_OK);
    CHECK(values[2] > 4900.0 && values[2] < 12000.0 && values[0] / 50.0 > 0.99 * values[1]);

    CHECK(cagedyn_sim_new(model) == NULL && cagedyn_error_status() == CAGEDYN_ERR_BAD_SCENE);
    CHECK(strstr(cagedyn_error_message(), "inner_ring.motion.space: rollers move over time in the plane") != NULL);
    cagedyn_equilibrium_free(found);
    cagedyn_model_free(model);
    cagedyn_model_free(plane);
    return failures > 0;
}
