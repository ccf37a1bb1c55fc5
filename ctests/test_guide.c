/* The grease-lubricated guide in C: whirl, inputs that the host takes over, and what is not simulated. */
#include "check.h"
#include <math.h>

static double output(cagedyn_sim *sim, const cagedyn_model *m, const char *name)
{
    double value = NAN;
    CHECK(cagedyn_sim_get_output(sim, cagedyn_model_find_output(m, name), &value) == CAGEDYN_OK);
    return value;
}

static double evaluations(const cagedyn_sim *sim, const char *law)
{
    double counts[64];
    int64_t n = cagedyn_law_count();
    CHECK(n <= 64 && cagedyn_sim_law_evaluations(sim, counts, n) == CAGEDYN_OK);
    for (int64_t i = 0; i < n && n <= 64; i++)
        if (strcmp(cagedyn_law_name(i), law) == 0) return counts[i];
    CHECK(!"a law of this name");
    return NAN;
}

/* From rest in the centre, the cage whirls backwards, carried by the film alone. */
static void check_whirl(const cagedyn_model *m)
{
    cagedyn_sim *sim = cagedyn_sim_new(m);
    double sum = 0.0;
    CHECK(cagedyn_sim_advance_to(sim, 40e-3) == CAGEDYN_OK);
    for (int i = 1; i <= 100; i++) {
        CHECK(cagedyn_sim_step(sim, 0.1e-3) == CAGEDYN_OK);
        sum += output(sim, m, "cage.whirl_speed") / 100.0;
    }
    CHECK(sum > -1960.0 * 1.02 && sum < -1960.0 * 0.98);
    CHECK(output(sim, m, "guide.film_share") > 1.0 - 1e-12);
    CHECK(output(sim, m, "guide.solid_eps") == 0.0);
    CHECK(evaluations(sim, "guide_film") > 1000.0 && evaluations(sim, "pocket_plane") > 100.0);
    CHECK(evaluations(sim, "outer_raceway") == 0.0 && evaluations(sim, "traction") == 0.0);
    CHECK(cagedyn_law_name(-1)[0] == '\0' && cagedyn_law_name(cagedyn_law_count())[0] == '\0');
    CHECK_FAILS(cagedyn_sim_law_evaluations(sim, &sum, 1), CAGEDYN_ERR_WRONG_SIZE, "out");
    cagedyn_sim_free(sim);
}

/* The elements stay where they are when the host changes their speed, and go on with the new one. */
static void check_prescribed_motion(const cagedyn_model *m)
{
    cagedyn_sim *sim = cagedyn_sim_new(m);
    int64_t speed = cagedyn_model_find_input(m, "inner_ring.speed");
    double ring = 0.0, before, orbit;
    CHECK(cagedyn_sim_get_input(sim, speed, &ring) == CAGEDYN_OK);
    CHECK(cagedyn_sim_advance_to(sim, 1e-3) == CAGEDYN_OK);
    before = output(sim, m, "element[3].orbit_angle");
    orbit = (before - 3.0 * 2.0 * acos(-1.0) / 25.0) / 1e-3;
    CHECK(fabs(orbit / ring - 0.45387) < 1e-4);
    CHECK(cagedyn_sim_set_input(sim, speed, 2.0 * ring) == CAGEDYN_OK);
    CHECK(fabs(output(sim, m, "element[3].orbit_angle") - before) < 1e-12);
    CHECK(cagedyn_sim_step(sim, 1e-3) == CAGEDYN_OK);
    CHECK(fabs(output(sim, m, "element[3].orbit_angle") - before - 2e-3 * orbit) < 1e-12);
    CHECK(cagedyn_sim_release_input(sim, speed) == CAGEDYN_OK);
    CHECK(cagedyn_sim_step(sim, 1e-3) == CAGEDYN_OK);
    CHECK(fabs(output(sim, m, "element[3].orbit_angle") - before - 3e-3 * orbit) < 1e-12);
    cagedyn_sim_free(sim);
}

/* A hotter grease is thinner; one without viscosity is an error that leaves the simulation as it was. */
static void check_temperature(const cagedyn_model *m)
{
    cagedyn_sim *sim = cagedyn_sim_new(m);
    int64_t temperature = cagedyn_model_find_input(m, "lubricant.temperature");
    double time = -1.0;
    CHECK(fabs(output(sim, m, "lubricant.viscosity") - 0.0924) < 1e-6);
    CHECK(cagedyn_sim_set_input(sim, temperature, 373.15) == CAGEDYN_OK);
    CHECK(cagedyn_sim_step(sim, 1e-3) == CAGEDYN_OK);
    CHECK(evaluations(sim, "viscosity_temperature") == 1.0);
    CHECK(fabs(output(sim, m, "lubricant.viscosity") - 0.01056) < 1e-7);
    CHECK_FAILS(cagedyn_sim_set_input(sim, temperature, 20.0), CAGEDYN_ERR_BAD_VALUE, "degrees Celsius, 293.15 K");
    CHECK_FAILS(cagedyn_sim_set_input(sim, temperature, 160.0), CAGEDYN_ERR_BAD_VALUE, "the viscosity");
    CHECK(cagedyn_sim_time(sim, &time) == CAGEDYN_OK && time == 1e-3);
    CHECK(fabs(output(sim, m, "lubricant.viscosity") - 0.01056) < 1e-7);
    CHECK(cagedyn_sim_release_input(sim, temperature) == CAGEDYN_OK);
    CHECK(cagedyn_sim_step(sim, 1e-3) == CAGEDYN_OK);
    cagedyn_sim_free(sim);
}

/* External force and torque on the cage exist only where the scene asks for them. */
static void check_cage_load(const char *json)
{
    const char *bare = "cage.pocket=null\ncage.guide=null\ngravity=null\nlubricant=null\ncage.load={}";
    cagedyn_model *m = cagedyn_model_from_json_with(json, bare);
    cagedyn_sim *sim = cagedyn_sim_new(m);
    CHECK(m != NULL && cagedyn_model_state_count(m) == 6);
    CHECK(cagedyn_sim_set_input(sim, cagedyn_model_find_input(m, "cage.force_z"), 0.01234) == CAGEDYN_OK);
    CHECK(cagedyn_sim_set_input(sim, cagedyn_model_find_input(m, "cage.torque"), 2.511e-5) == CAGEDYN_OK);
    CHECK(cagedyn_sim_step(sim, 10e-3) == CAGEDYN_OK);
    /* 1 m/s^2 and 1 rad/s^2 for 10 ms. */
    CHECK(fabs(output(sim, m, "cage.z") - 0.5e-4) < 1e-12);
    CHECK(fabs(output(sim, m, "cage.speed") - 142.5 - 0.01) < 1e-9);
    for (int64_t i = 0; i < cagedyn_law_count(); i++) CHECK(evaluations(sim, cagedyn_law_name(i)) == 0.0);
    cagedyn_sim_free(sim);
    cagedyn_model_free(m);
}

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
    CHECK(cagedyn_model_find_input(model, "cage.force_z") == CAGEDYN_ERR_UNKNOWN_NAME);
    check_whirl(model);
    check_prescribed_motion(model);
    check_temperature(model);
    check_cage_load(cagedyn_model_scene_json(model));
    cagedyn_model_free(model);
    return failures != 0;
}
