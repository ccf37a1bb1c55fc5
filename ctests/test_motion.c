/* Motion of a cage and quantities over the orbit, from a host's own numbers. */
#include "check.h"
#include <math.h>

enum { RECORDS = 1000, SECTORS = 36 };

static int64_t quantity(const char *name)
{
    return place_of(name, cagedyn_motion_name, cagedyn_motion_count());
}

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
    const double pi = 3.141592653589793;
    static double t[RECORDS], y[RECORDS], z[RECORDS], whirl[RECORDS], cage[RECORDS];
    for (int i = 0; i < RECORDS; i++) {
        t[i] = 1e-4 * i;
        y[i] = 1e-4 * cos(-2000.0 * t[i]);
        z[i] = 1e-4 * sin(-2000.0 * t[i]);
        whirl[i] = -2000.0;
        cage[i] = 140.0;
    }
    int64_t n = cagedyn_motion_count();
    double *x = numbers(n);
    CHECK(n == 14 && strcmp(cagedyn_motion_name(n), "") == 0);
    CHECK(cagedyn_cage_motion(t, y, z, whirl, cage, RECORDS, 2e-4, 0.05, x, n) == CAGEDYN_OK);
    CHECK(x[quantity("motion")] == 3.0 && x[quantity("mean_whirl_speed")] == -2000.0);
    CHECK(fabs(x[quantity("mean_radius")] - 1e-4) < 1e-12 && fabs(x[quantity("turns")] + 15.88) < 0.01);
    CHECK(x[quantity("backward_share")] == 1.0 && x[quantity("irregular_share")] == 0.0 && x[quantity("intermittent")] == 0.0);
    CHECK(x[quantity("settling_time")] == 0.0 && fabs(x[quantity("velocity_deviation")]) < 1e-9);

    /* A cage that rests has a place and no velocity; without a guide too. */
    for (int i = 0; i < RECORDS; i++) { y[i] = 1e-5; z[i] = 0.0; whirl[i] = 0.0; }
    CHECK(cagedyn_cage_motion(t, y, z, whirl, cage, RECORDS, 0.0, 0.0, x, n) == CAGEDYN_OK);
    CHECK(x[quantity("motion")] == 0.0 && isnan(x[quantity("velocity_deviation")]));

    x[0] = -7.0;
    CHECK_FAILS(cagedyn_cage_motion(t, y, NULL, whirl, cage, RECORDS, 2e-4, 0.0, x, n), CAGEDYN_ERR_NULL_ARGUMENT, "z: is NULL");
    CHECK_FAILS(cagedyn_cage_motion(t, y, z, whirl, cage, -1, 2e-4, 0.0, x, n), CAGEDYN_ERR_WRONG_SIZE, "times: length -1");
    CHECK_FAILS(cagedyn_cage_motion(t, y, z, whirl, cage, 2, 2e-4, 0.0, x, n), CAGEDYN_ERR_BAD_VALUE, "fewer than three");
    CHECK_FAILS(cagedyn_cage_motion(t, y, z, whirl, cage, RECORDS, -1.0, 0.0, x, n), CAGEDYN_ERR_BAD_VALUE, "clearance: -1");
    CHECK_FAILS(cagedyn_cage_motion(y, y, z, whirl, cage, RECORDS, 2e-4, 0.0, x, n), CAGEDYN_ERR_BAD_VALUE, "times: do not grow");
    z[5] = NAN;
    CHECK_FAILS(cagedyn_cage_motion(t, y, z, whirl, cage, RECORDS, 2e-4, 0.0, x, n), CAGEDYN_ERR_BAD_VALUE, "z[5]: NaN");
    CHECK_FAILS(cagedyn_cage_motion(t, y, z, whirl, cage, RECORDS, 2e-4, 0.0, x, n - 1), CAGEDYN_ERR_WRONG_SIZE, "out: length 13");
    CHECK(x[0] == -7.0);

    /* A load within 45 degrees of the bottom, over several turns. */
    static double angle[RECORDS], load[RECORDS], out[4 * SECTORS];
    for (int i = 0; i < RECORDS; i++) {
        angle[i] = -0.0314159 * i;
        load[i] = fmax(0.0, cos(angle[i] + 0.5 * pi) - sqrt(0.5));
    }
    CHECK(cagedyn_over_orbit_count() == 4 && strcmp(cagedyn_over_orbit_name(3), "positive_share") == 0);
    CHECK(cagedyn_over_orbit(angle, load, RECORDS, SECTORS, out, 4 * SECTORS) == CAGEDYN_OK);
    CHECK(out[0] == 0.0 && out[26] > 0.2 && out[27] > 0.2 && out[3 * SECTORS + 26] == 1.0 && out[3 * SECTORS + 9] == 0.0);
    CHECK(out[SECTORS + 26] >= out[26] && out[2 * SECTORS + 26] >= out[SECTORS + 26]);
    CHECK_FAILS(cagedyn_over_orbit(angle, load, RECORDS, 0, out, 0), CAGEDYN_ERR_BAD_VALUE, "sectors: 0");
    CHECK_FAILS(cagedyn_over_orbit(angle, load, RECORDS, SECTORS, out, 5), CAGEDYN_ERR_WRONG_SIZE, "out: length 5");
    CHECK(cagedyn_over_orbit(NULL, NULL, 0, SECTORS, out, 4 * SECTORS) == CAGEDYN_OK && isnan(out[0]));

    free(x);
    cagedyn_model_free(model);
    return 0;
}
