/* Many simulations at once: one bearing at several speeds, on all cores, with mean and extremes from every step.
 *
 *   cc -std=c99 batch.c $(pkg-config --cflags --libs cagedyn) -o batch
 *   ./batch scenes/nu2310.json
 */
#include "example.h"

enum { RUNS = 6 };

/* The scene at this speed, with the moment of the guide watched in every step. */
static cagedyn_sim *at_speed(const cagedyn_model *scene, double speed, int64_t *moment)
{
    char overrides[128];
    snprintf(overrides, sizeof overrides, "inner_ring.speed.constant=%.3f\nrecord.extremes=[\"guide.moment\"]", speed);
    cagedyn_model *model = cagedyn_model_from_json_with(cagedyn_model_scene_json(scene), overrides);
    cagedyn_sim *sim = model ? cagedyn_sim_new(model) : NULL;
    if (sim == NULL) fail("simulation");
    *moment = cagedyn_model_find_output(model, "guide.moment");
    cagedyn_model_free(model); /* The simulation keeps what it needs. */
    return sim;
}

int main(int argc, char **argv)
{
    cagedyn_model *scene = model_of(argc, argv);
    cagedyn_batch *batch = cagedyn_batch_new();
    int64_t moment = -1;
    double interval[7];
    for (int k = 0; k < RUNS; k++) {
        if (cagedyn_batch_add(batch, at_speed(scene, -100.0 - 50.0 * k, &moment)) < 0) fail("add");
    }
    /* 5 ms to settle, 5 ms to look at. */
    if (cagedyn_batch_advance_to(batch, 5e-3, 0) != CAGEDYN_OK) fail("batch");
    for (int k = 0; k < RUNS; k++) {
        if (cagedyn_sim_begin_interval(cagedyn_batch_sim(batch, k)) != CAGEDYN_OK) fail("interval");
    }
    if (cagedyn_batch_advance_to(batch, 10e-3, 0) != CAGEDYN_OK) fail("batch");
    printf("%12s %12s %12s %12s\n", "w [rad/s]", "mean [N m]", "least", "largest");
    for (int k = 0; k < RUNS; k++) {
        if (cagedyn_sim_get_interval(cagedyn_batch_sim(batch, k), moment, interval, 7) != CAGEDYN_OK) fail("interval");
        printf("%12.0f %12.5f %12.5f %12.5f\n", -100.0 - 50.0 * k, interval[4], interval[2], interval[3]);
    }
    cagedyn_batch_free(batch);
    cagedyn_model_free(scene);
    return EXIT_SUCCESS;
}
