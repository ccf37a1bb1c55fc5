/* Heat balance: steady temperatures, warming up, where heat goes, and what is refused. The scene is that of a warm greased guide. */
#include <math.h>

#include "check.h"

static int64_t quantity(const char *name)
{
    return place_of(name, cagedyn_heat_quantity_name, cagedyn_heat_quantity_count());
}

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
    cagedyn_heat *heat = cagedyn_heat_new(model);
    int64_t lumps = cagedyn_heat_lump_count(heat), links = cagedyn_heat_link_count(heat);
    int64_t sources = cagedyn_heat_source_count(heat), n = cagedyn_heat_quantity_count();
    double *start = numbers(lumps), *now = numbers(lumps), *into = numbers(lumps), *flows = numbers(links);
    double *source = numbers(sources), *x = numbers(n);
    CHECK(heat != NULL && lumps == 6 && links == 8 && sources > 0 && n == 8);
    int64_t film = -1;
    for (int64_t i = 0; i < lumps; i++) {
        if (strcmp(cagedyn_heat_lump_name(heat, i), "film") == 0) film = i;
    }
    CHECK(film >= 0 && strcmp(cagedyn_heat_lump_name(heat, lumps), "") == 0);

    CHECK(cagedyn_heat_temperatures(heat, start, lumps) == CAGEDYN_OK && start[film] > 273.0);
    CHECK_FAILS(cagedyn_heat_into_lumps(heat, into, lumps), CAGEDYN_ERR_BAD_STATE, "no motion has been run");
    CHECK_FAILS(cagedyn_heat_step(heat, 0.0), CAGEDYN_ERR_BAD_VALUE, "duration: 0 s");

    /* A minute of warming up in steps. */
    double before = start[film];
    for (double step = 5.0; step < 50.0; step *= 2.0) {
        CHECK(cagedyn_heat_step(heat, step) == CAGEDYN_OK && cagedyn_heat_temperatures(heat, now, lumps) == CAGEDYN_OK);
        CHECK(now[film] > before);
        before = now[film];
    }

    CHECK(cagedyn_heat_settle(heat) == CAGEDYN_OK && cagedyn_heat_temperatures(heat, now, lumps) == CAGEDYN_OK);
    CHECK(now[film] > 330.65 && now[film] < 331.25);
    CHECK(cagedyn_heat_into_lumps(heat, into, lumps) == CAGEDYN_OK);
    CHECK(cagedyn_heat_flows(heat, flows, links) == CAGEDYN_OK);
    CHECK(cagedyn_heat_sources(heat, source, sources) == CAGEDYN_OK);
    CHECK(cagedyn_heat_quantities(heat, x, n) == CAGEDYN_OK);
    CHECK(x[quantity("viscosity")] > 0.0 && x[quantity("whirl_speed")] < 0.0 && x[quantity("bursts")] > 3.0);
    CHECK(x[quantity("standard_error")] == 0.0 && x[quantity("radial_clearance")] != x[quantity("radial_clearance")]);

    /* What goes into a lump flows out of it, but for what temperatures that have settled to 2 mK still hold back. */
    double all = 0.0, out = 0.0;
    for (int64_t i = 0; i < lumps; i++) {
        double rest = into[i];
        all += into[i];
        for (int64_t k = 0; k < links; k++) {
            int64_t ends[2];
            CHECK(cagedyn_heat_link(heat, k, ends, 2) == CAGEDYN_OK && ends[0] != ends[1]);
            if (ends[0] == i) rest -= flows[k];
            if (ends[1] == i) rest += flows[k];
        }
        CHECK(rest > -0.05 && rest < 0.05);
    }
    for (int64_t k = 0; k < links; k++) {
        int64_t ends[2];
        CHECK(cagedyn_heat_link(heat, k, ends, 2) == CAGEDYN_OK);
        if (ends[1] == -1) out += flows[k];
        if (ends[0] == -1) out -= flows[k];
    }
    CHECK(all > 1.0 && out > all - 0.1 && out < all + 0.1);
    double motion = 0.0;
    for (int64_t i = 0; i < sources; i++) {
        CHECK(strlen(cagedyn_heat_source_name(heat, i)) > 0);
        motion += source[i];
    }
    CHECK(motion > 0.0 && motion < all);

    /* The heat balance goes on after what fails. */
    double kept = now[film];
    now[film] = 2000.0;
    CHECK_FAILS(cagedyn_heat_set_temperatures(heat, now, lumps), CAGEDYN_ERR_BAD_VALUE, "2000 K of film");
    CHECK(cagedyn_heat_temperatures(heat, now, lumps) == CAGEDYN_OK && now[film] == kept);
    CHECK_FAILS(cagedyn_heat_flows(heat, flows, links - 1), CAGEDYN_ERR_WRONG_SIZE, "must be");
    CHECK_FAILS(cagedyn_heat_quantities(heat, NULL, n), CAGEDYN_ERR_NULL_ARGUMENT, "out: is NULL");
    CHECK(cagedyn_heat_set_temperatures(heat, start, lumps) == CAGEDYN_OK && cagedyn_heat_step(heat, 1.0) == CAGEDYN_OK);

    /* What a watch ends goes on with another call. */
    cagedyn_watch *watch = cagedyn_watch_new();
    double progress[2];
    CHECK(cagedyn_watch_set_wall_time_limit(watch, 0.0) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_heat_settle_with_watch(heat, watch), CAGEDYN_ERR_OUT_OF_TIME, "wall time");
    CHECK_FAILS(cagedyn_heat_step_with_watch(heat, 1.0, watch), CAGEDYN_ERR_OUT_OF_TIME, "wall time");
    CHECK(cagedyn_watch_set_wall_time_limit(watch, INFINITY) == CAGEDYN_OK);
    CHECK(cagedyn_watch_cancel(watch) == CAGEDYN_OK);
    CHECK_FAILS(cagedyn_heat_settle_with_watch(heat, watch), CAGEDYN_ERR_CANCELLED, "stopped on request");
    CHECK(cagedyn_heat_settle_with_watch(heat, watch) == CAGEDYN_OK);
    CHECK(cagedyn_watch_progress(watch, progress, 2) == CAGEDYN_OK && progress[0] == 1.0 && progress[1] > 1.0);
    cagedyn_watch_free(watch);
    cagedyn_heat_free(heat);
    cagedyn_heat_free(NULL);

    CHECK(cagedyn_heat_new(NULL) == NULL && cagedyn_error_status() == CAGEDYN_ERR_NULL_ARGUMENT);
    cagedyn_model *cold = cagedyn_model_from_json_with(
        cagedyn_model_scene_json(model), "heat=null\nlubricant.viscosity={\"constant\":0.09}");
    CHECK(cold != NULL && cagedyn_heat_new(cold) == NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_BAD_SCENE && strstr(cagedyn_error_message(), "heat: missing") != NULL);
    cagedyn_model_free(cold);

    free(start);
    free(now);
    free(into);
    free(flows);
    free(source);
    free(x);
    cagedyn_model_free(model);
    return failures != 0;
}
