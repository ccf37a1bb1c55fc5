/* Equilibrium in C: names, numbers, stiffness, and what is refused. The scene is that of an angular contact bearing. */
#include "check.h"

#include <math.h>

#define CHECK_TEXT(found, expected) CHECK(strcmp((found), (expected)) == 0)

static void check_balls(const cagedyn_model *model)
{
    cagedyn_equilibrium *found = cagedyn_equilibrium_find(model, NULL);
    CHECK(found != NULL);
    int64_t n = cagedyn_equilibrium_coordinate_count(found);
    CHECK(n == 5);
    CHECK_TEXT(cagedyn_equilibrium_coordinate_name(found, 3), "tilt_y");
    CHECK_TEXT(cagedyn_equilibrium_coordinate_unit(found, 3), "rad");
    double x[5], load[5], stiffness[25];
    CHECK(cagedyn_equilibrium_displacement(found, x, 5) == CAGEDYN_OK);
    CHECK(cagedyn_equilibrium_load(found, load, 5) == CAGEDYN_OK);
    CHECK(cagedyn_equilibrium_stiffness(found, stiffness, 25) == CAGEDYN_OK);
    CHECK(fabs(x[0] - 36.1e-6) < 0.05e-6 && x[1] == 0.0 && fabs(load[0] - 17800.0) < 1e-6);
    for (int i = 0; i < 5; i++) {
        for (int k = 0; k < i; k++) CHECK(fabs(stiffness[5 * i + k] - stiffness[5 * k + i]) < 1e-6 * stiffness[0]);
    }
    CHECK(cagedyn_equilibrium_element_count(found) == 16);
    CHECK(cagedyn_equilibrium_contact_count(found) == 32);
    CHECK_TEXT(cagedyn_equilibrium_contact_name(found, 1), "ball[0].inner_raceway");
    double values[16];
    int64_t known = cagedyn_equilibrium_contact_quantity_count(found);
    CHECK(known > 5 && known <= 16);
    CHECK(cagedyn_equilibrium_contact(found, 1, values, known) == CAGEDYN_OK);
    CHECK_TEXT(cagedyn_equilibrium_contact_quantity_name(found, 0), "normal_force");
    CHECK_TEXT(cagedyn_equilibrium_contact_quantity_unit(found, 1), "rad");
    CHECK(fabs(values[0] - 1678.9) < 0.05 && fabs(values[1] - 41.50 / 57.29578) < 1e-4);
    known = cagedyn_equilibrium_element_quantity_count(found);
    CHECK(cagedyn_equilibrium_element(found, 15, values, known) == CAGEDYN_OK);
    CHECK_TEXT(cagedyn_equilibrium_element_quantity_name(found, 0), "azimuth");
    CHECK_TEXT(cagedyn_equilibrium_element_quantity_unit(found, 3), "rad/s");
    CHECK(cagedyn_equilibrium_warning_count(found) == 0);

    /* What is wrong is told, and changes nothing. */
    double kept = 7.0;
    CHECK(cagedyn_equilibrium_displacement(found, &kept, 1) == CAGEDYN_ERR_WRONG_SIZE && kept == 7.0);
    CHECK(cagedyn_equilibrium_stiffness(found, NULL, 25) == CAGEDYN_ERR_NULL_ARGUMENT);
    CHECK(cagedyn_equilibrium_element(found, 16, values, known) == CAGEDYN_ERR_BAD_INDEX);
    CHECK(cagedyn_equilibrium_contact(found, -1, values, known) == CAGEDYN_ERR_BAD_INDEX);
    CHECK_TEXT(cagedyn_equilibrium_warning(found, 0), "");
    CHECK_TEXT(cagedyn_equilibrium_contact_name(found, 99), "");
    CHECK(cagedyn_equilibrium_contact_count(NULL) == CAGEDYN_ERR_NULL_ARGUMENT);
    cagedyn_equilibrium_free(found);
    cagedyn_equilibrium_free(NULL);

    CHECK(cagedyn_equilibrium_find(NULL, NULL) == NULL && cagedyn_error_status() == CAGEDYN_ERR_NULL_ARGUMENT);
    CHECK(cagedyn_equilibrium_find(model, "both") == NULL && cagedyn_error_status() == CAGEDYN_ERR_UNKNOWN_NAME);
    CHECK(strstr(cagedyn_error_message(), "control: 'both'") != NULL);
}

static void check_speed(const char *json)
{
    cagedyn_model *fast = cagedyn_model_from_json_with(
        json, "inner_ring.speed.constant=1047.1975511965977\ninner_ring.motion.space.load.x.constant=22250");
    CHECK(fast != NULL);
    cagedyn_equilibrium *found = cagedyn_equilibrium_find(fast, "outer");
    CHECK(found != NULL);
    double values[16];
    int64_t known = cagedyn_equilibrium_contact_quantity_count(found);
    double expected[2] = {33.58, 48.74};
    for (int ring = 0; ring < 2; ring++) {
        CHECK(cagedyn_equilibrium_contact(found, ring, values, known) == CAGEDYN_OK);
        CHECK(fabs(57.29578 * values[1] - expected[ring]) < 0.01);
    }
    cagedyn_equilibrium_free(found);
    cagedyn_model_free(fast);
}

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
    check_balls(model);
    check_speed(cagedyn_model_scene_json(model));
    cagedyn_model_free(model);
    return failures > 0;
}
