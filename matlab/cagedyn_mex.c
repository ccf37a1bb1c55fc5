/* Gateway to cagedyn for MATLAB and Octave: cagedyn_mex(command, ...). The classes Cagedyn, CagedynBatch and CagedynHeat use it; see
 * there. build_cagedyn.m compiles it.
 *
 * Handles are numbers that this gateway gives out; it knows those that live, so that a wrong one is an error and no crash.
 * Failures of the library are errors with the identifier cagedyn:ERR_... .
 */
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "cagedyn.h"
#include "mex.h"

/* CLOSED is a batch without its handle, which lives on for its simulations. */
typedef enum { FREE, MODEL, SIM, BATCH, HEAT, CLOSED } kind;

static const char *const wrong[] = {"", "not a model", "not a simulation", "not a batch", "not a heat balance", ""};

typedef struct {
    kind kind;
    void *pointer;
    /* Of a simulation: numbers of its model, and the handle of its batch or 0. */
    int64_t states, outputs, contacts, quantities, bodies, sources, components;
    size_t batch;
    /* Of a batch: how many of its simulations have handles. */
    size_t members;
} object;

static object *objects = NULL;
static size_t object_count = 0;

static void release(object *o)
{
    kind k = o->kind;
    object *batch = k == SIM && o->batch > 0 ? &objects[o->batch - 1] : o;
    if (k == MODEL) cagedyn_model_free((cagedyn_model *)o->pointer);
    if (k == SIM) cagedyn_sim_free((cagedyn_sim *)o->pointer);
    if (k == HEAT) cagedyn_heat_free((cagedyn_heat *)o->pointer);
    if (k != CLOSED) o->kind = k == BATCH ? CLOSED : FREE;
    if (batch != o) batch->members--;
    if (batch->kind == CLOSED && batch->members == 0) {
        cagedyn_batch_free((cagedyn_batch *)batch->pointer);
        batch->kind = FREE;
    }
}

static void release_all(void)
{
    size_t i;
    for (i = 0; i < object_count; i++) release(&objects[i]);
    if (objects != NULL) mxFree(objects);
    objects = NULL;
    object_count = 0;
}

static void refuse(const char *what)
{
    mexErrMsgIdAndTxt("cagedyn:usage", "%s", what);
}

static void fail_with(int32_t status, const char *message)
{
    char id[64];
    snprintf(id, sizeof id, "cagedyn:%s", cagedyn_status_name(status));
    mexErrMsgIdAndTxt(id, "%s", message);
}

/* Ends the command with the error of the library. */
static void fail(void)
{
    fail_with(cagedyn_error_status(), cagedyn_error_message());
}

static void check(int32_t status)
{
    if (status != CAGEDYN_OK) fail();
}

/* A place for an object; its number is its handle. */
static object *new_object(kind k, void *pointer, mxArray **handle)
{
    size_t i = 0;
    while (i < object_count && objects[i].kind != FREE) i++;
    if (i == object_count) {
        object *more = (object *)mxRealloc(objects, (object_count + 1) * sizeof(object));
        mexMakeMemoryPersistent(more);
        objects = more;
        object_count++;
    }
    memset(&objects[i], 0, sizeof objects[i]);
    objects[i].kind = k;
    objects[i].pointer = pointer;
    *handle = mxCreateDoubleScalar((double)(i + 1));
    return &objects[i];
}

static object *object_of(const mxArray *handle, kind k)
{
    double number = mxIsDouble(handle) && mxGetNumberOfElements(handle) == 1 ? mxGetScalar(handle) : 0.0;
    size_t i = number >= 1.0 && number <= (double)object_count ? (size_t)number - 1 : object_count;
    if (i == object_count || objects[i].kind != k) refuse(wrong[k]);
    return &objects[i];
}

static char *text_of(const mxArray *array)
{
    char *text = mxIsChar(array) ? mxArrayToString(array) : NULL;
    if (text == NULL) refuse("a text is needed");
    return text;
}

static double scalar_of(const mxArray *array)
{
    if (!mxIsDouble(array) || mxGetNumberOfElements(array) != 1) refuse("a number is needed");
    return mxGetScalar(array);
}

static const double *numbers_of(const mxArray *array, int64_t *length)
{
    if (!mxIsDouble(array) || mxIsComplex(array) || mxIsSparse(array)) refuse("an array of real numbers is needed");
    *length = (int64_t)mxGetNumberOfElements(array);
    return mxGetPr(array);
}

static mxArray *column(int64_t length)
{
    return mxCreateDoubleMatrix((mwSize)length, 1, mxREAL);
}

/* A struct of numbers that the library names. */
static mxArray *named(int64_t count, const char *(*name)(int64_t), const double *values)
{
    mxArray *all = mxCreateStructMatrix(1, 1, 0, NULL);
    int64_t i;
    for (i = 0; i < count; i++) {
        mxAddField(all, name(i));
        mxSetField(all, 0, name(i), mxCreateDoubleScalar(values[i]));
    }
    return all;
}

static void set(mxArray *all, const char *name, mxArray *value)
{
    mxAddField(all, name);
    mxSetField(all, 0, name, value);
}

typedef const char *(*text_fn)(const cagedyn_model *, int64_t);

typedef struct {
    const char *kind;
    int64_t (*count)(const cagedyn_model *);
    text_fn name, unit, description;
} list;

#define LIST(kind)                                                                                                     \
    {#kind, cagedyn_model_##kind##_count, cagedyn_model_##kind##_name, cagedyn_model_##kind##_unit,                    \
     cagedyn_model_##kind##_description}
#define NAMES(kind) {#kind, cagedyn_model_##kind##_count, cagedyn_model_##kind##_name, NULL, NULL}

static const list lists[] = {LIST(state),   LIST(input),         LIST(output),          LIST(contact_quantity),
                             LIST(geometry), NAMES(contact),      NAMES(body),           NAMES(force_source),
                             LIST(force_component)};

/* names(model, kind, what): a column of texts; what is name, unit or description. */
static mxArray *names(const cagedyn_model *model, const char *kind_name, const char *what)
{
    size_t k = 0;
    int64_t i, n;
    text_fn text;
    mxArray *cell;
    while (k < sizeof lists / sizeof lists[0] && strcmp(lists[k].kind, kind_name) != 0) k++;
    if (k == sizeof lists / sizeof lists[0]) refuse("there are no names of this kind");
    text = strcmp(what, "name") == 0 ? lists[k].name : strcmp(what, "unit") == 0 ? lists[k].unit : lists[k].description;
    n = lists[k].count(model);
    if (text == NULL) n = 0;
    cell = mxCreateCellMatrix((mwSize)n, 1);
    for (i = 0; i < n; i++) mxSetCell(cell, (mwIndex)i, mxCreateString(text(model, i)));
    return cell;
}

/* The sparse Jacobian of a simulation. */
static mxArray *jacobian(object *sim, const object *model, double t, const double *state, int64_t length)
{
    int64_t i, entries = cagedyn_model_jacobian_entry_count((cagedyn_model *)model->pointer);
    int64_t n = cagedyn_model_state_count((cagedyn_model *)model->pointer);
    int64_t *starts = (int64_t *)mxCalloc((size_t)n + 1, sizeof(int64_t));
    int64_t *rows = (int64_t *)mxCalloc((size_t)entries, sizeof(int64_t));
    mxArray *matrix = mxCreateSparse((mwSize)n, (mwSize)n, (mwSize)entries, mxREAL);
    check(cagedyn_model_jacobian_pattern((cagedyn_model *)model->pointer, starts, n + 1, rows, entries));
    check(cagedyn_sim_sparse_jacobian((cagedyn_sim *)sim->pointer, t, state, length, mxGetPr(matrix), entries));
    for (i = 0; i <= n; i++) mxGetJc(matrix)[i] = (mwIndex)starts[i];
    for (i = 0; i < entries; i++) mxGetIr(matrix)[i] = (mwIndex)rows[i];
    mxFree(starts);
    mxFree(rows);
    return matrix;
}

/* Which outputs (rows) may change at once with which inputs (columns), as a sparse matrix of ones. */
static mxArray *feedthrough(const object *model)
{
    cagedyn_model *m = (cagedyn_model *)model->pointer;
    int64_t i, entries = cagedyn_model_feedthrough_entry_count(m), n = cagedyn_model_input_count(m);
    int64_t *starts = (int64_t *)mxCalloc((size_t)n + 1, sizeof(int64_t));
    int64_t *rows = (int64_t *)mxCalloc((size_t)entries + 1, sizeof(int64_t));
    mxArray *matrix =
        mxCreateSparse((mwSize)cagedyn_model_output_count(m), (mwSize)n, (mwSize)(entries > 0 ? entries : 1), mxREAL);
    check(cagedyn_model_feedthrough_pattern(m, starts, n + 1, rows, entries));
    for (i = 0; i <= n; i++) mxGetJc(matrix)[i] = (mwIndex)starts[i];
    for (i = 0; i < entries; i++) {
        mxGetIr(matrix)[i] = (mwIndex)rows[i];
        mxGetPr(matrix)[i] = 1.0;
    }
    mxFree(starts);
    mxFree(rows);
    return matrix;
}

static void new_model(int nrhs, const mxArray **args, mxArray **out)
{
    char *json = text_of(args[0]), *overrides = nrhs > 1 ? text_of(args[1]) : NULL;
    cagedyn_model *model = cagedyn_model_from_json_with(json, overrides != NULL ? overrides : "");
    mxFree(json);
    if (overrides != NULL) mxFree(overrides);
    if (model == NULL) fail();
    new_object(MODEL, model, out);
}

static void new_sim(int nrhs, const mxArray **args, mxArray **out)
{
    cagedyn_model *m = (cagedyn_model *)object_of(args[0], MODEL)->pointer;
    cagedyn_sim *sim = nrhs > 1 ? cagedyn_sim_new_with_preset(m, (int32_t)scalar_of(args[1])) : cagedyn_sim_new(m);
    object *o;
    if (sim == NULL) fail();
    o = new_object(SIM, sim, out);
    o->states = cagedyn_model_state_count(m);
    o->outputs = cagedyn_model_output_count(m);
    o->contacts = cagedyn_model_contact_count(m);
    o->quantities = cagedyn_model_contact_quantity_count(m);
    o->bodies = cagedyn_model_body_count(m);
    o->sources = cagedyn_model_force_source_count(m);
    o->components = cagedyn_model_force_component_count(m);
}

/* Steady whirls of a model: what is known of each point in a column, by the names of `quantities`. */
static mxArray *whirl(const cagedyn_model *model, int n, const mxArray **args)
{
    char *path = n == 3 ? text_of(args[0]) : NULL;
    cagedyn_whirl *w = path != NULL ? cagedyn_whirl_follow(model, path, scalar_of(args[1]), scalar_of(args[2]))
                                    : cagedyn_whirl_steady(model);
    int64_t i, points, quantities = cagedyn_whirl_quantity_count(), waves, eigenvalues;
    int32_t status = CAGEDYN_OK;
    mxArray *all = mxCreateStructMatrix(1, 1, 0, NULL), *names, *values, *amplitudes, *rates, *frequencies;
    if (path != NULL) mxFree(path);
    if (w == NULL) fail();
    points = cagedyn_whirl_point_count(w);
    waves = cagedyn_whirl_wave_count(w);
    eigenvalues = cagedyn_whirl_eigenvalue_count(w);
    set(all, "quantities", names = mxCreateCellMatrix((mwSize)quantities, 1));
    set(all, "values", values = mxCreateDoubleMatrix((mwSize)quantities, (mwSize)points, mxREAL));
    set(all, "amplitudes", amplitudes = mxCreateDoubleMatrix((mwSize)waves, (mwSize)points, mxREAL));
    set(all, "rates", rates = mxCreateDoubleMatrix((mwSize)eigenvalues, (mwSize)points, mxREAL));
    set(all, "frequencies", frequencies = mxCreateDoubleMatrix((mwSize)eigenvalues, (mwSize)points, mxREAL));
    set(all, "ending", mxCreateString(cagedyn_whirl_end(w)));
    set(all, "why", mxCreateString(cagedyn_whirl_why(w)));
    for (i = 0; i < quantities; i++) mxSetCell(names, (mwIndex)i, mxCreateString(cagedyn_whirl_quantity_name(i)));
    for (i = 0; i < points && status == CAGEDYN_OK; i++) {
        status = cagedyn_whirl_point(w, i, mxGetPr(values) + i * quantities, quantities);
        if (status == CAGEDYN_OK && waves > 0)
            status = cagedyn_whirl_amplitudes(w, i, mxGetPr(amplitudes) + i * waves, waves);
        if (status == CAGEDYN_OK)
            status = cagedyn_whirl_eigenvalues(w, i, mxGetPr(rates) + i * eigenvalues,
                                               mxGetPr(frequencies) + i * eigenvalues, eigenvalues);
    }
    cagedyn_whirl_free(w);
    check(status);
    return all;
}

/* batch(simulations): a row or column of handles, which stay those of its simulations. */
static void new_batch(const mxArray *handles, mxArray **out)
{
    int64_t i, n = 0;
    const double *numbers = numbers_of(handles, &n);
    cagedyn_batch *batch = cagedyn_batch_new();
    size_t at;
    if (batch == NULL) fail();
    at = (size_t)(new_object(BATCH, batch, out) - objects);
    for (i = 0; i < n; i++) {
        size_t k = numbers[i] >= 1.0 && numbers[i] <= (double)object_count ? (size_t)numbers[i] - 1 : at;
        if (objects[k].kind != SIM || cagedyn_batch_add(batch, (cagedyn_sim *)objects[k].pointer) < 0) {
            kind other = objects[k].kind;
            /* Those that were added stay usable. */
            release(&objects[at]);
            if (other != SIM) refuse(wrong[SIM]);
            fail();
        }
        objects[k].batch = at + 1;
        objects[at].members++;
    }
}

/* batch_advance(batch, t, threads, seconds): all of them, each for so many seconds of wall time; a row for each with the name of its
 * status, empty for success, and its message. */
static mxArray *batch_advance(cagedyn_batch *batch, double t, int64_t threads, const double *seconds, int64_t length)
{
    int64_t i, count = cagedyn_batch_count(batch);
    char message[512];
    int32_t status;
    int failed = 0;
    mxArray *rows;
    if (length != count) refuse("a limit is needed for each simulation");
    for (i = 0; i < count; i++) check(cagedyn_sim_set_wall_time_limit(cagedyn_batch_sim(batch, i), seconds[i]));
    status = cagedyn_batch_advance_to(batch, t, threads);
    snprintf(message, sizeof message, "%s", cagedyn_error_message());
    rows = mxCreateCellMatrix((mwSize)count, 2);
    for (i = 0; i < count; i++) {
        int32_t one = cagedyn_batch_status(batch, i);
        failed |= one != CAGEDYN_OK;
        mxSetCell(rows, (mwIndex)i, mxCreateString(one == CAGEDYN_OK ? "" : cagedyn_status_name(one)));
        mxSetCell(rows, (mwIndex)(count + i), mxCreateString(cagedyn_batch_message(batch, i)));
    }
    /* The call itself was refused. */
    if (status != CAGEDYN_OK && !failed) fail_with(status, message);
    return rows;
}

static int batch_command(const char *c, object *o, int n, const mxArray **args, mxArray **out)
{
    cagedyn_batch *batch = (cagedyn_batch *)o->pointer;
    if (strcmp(c, "batch_advance") == 0 && n == 3) {
        int64_t length = 0;
        const double *seconds = numbers_of(args[2], &length);
        *out = batch_advance(batch, scalar_of(args[0]), (int64_t)scalar_of(args[1]), seconds, length);
    } else if (strcmp(c, "batch_cancel") == 0) {
        cagedyn_monitor *monitor = cagedyn_monitor_new(batch);
        int32_t status = cagedyn_monitor_cancel(monitor);
        cagedyn_monitor_free(monitor);
        check(status);
    } else {
        return 0;
    }
    return 1;
}

static int heat_command(const char *c, object *o, int n, const mxArray **args, mxArray **out)
{
    cagedyn_heat *heat = (cagedyn_heat *)o->pointer;
    int64_t i, length, lumps = cagedyn_heat_lump_count(heat), sources = cagedyn_heat_source_count(heat);
    int64_t links = cagedyn_heat_link_count(heat), quantities = cagedyn_heat_quantity_count();
    if (strcmp(c, "heat_lumps") == 0) {
        *out = mxCreateCellMatrix((mwSize)lumps, 1);
        for (i = 0; i < lumps; i++) mxSetCell(*out, (mwIndex)i, mxCreateString(cagedyn_heat_lump_name(heat, i)));
    } else if (strcmp(c, "heat_sources") == 0) {
        *out = mxCreateCellMatrix((mwSize)sources, 1);
        for (i = 0; i < sources; i++) mxSetCell(*out, (mwIndex)i, mxCreateString(cagedyn_heat_source_name(heat, i)));
    } else if (strcmp(c, "heat_links") == 0) {
        *out = mxCreateDoubleMatrix((mwSize)links, 2, mxREAL);
        for (i = 0; i < links; i++) {
            int64_t ends[2];
            check(cagedyn_heat_link(heat, i, ends, 2));
            mxGetPr(*out)[i] = (double)ends[0] + 1.0;
            mxGetPr(*out)[links + i] = (double)ends[1] + 1.0;
        }
    } else if (strcmp(c, "heat_settle") == 0) {
        check(cagedyn_heat_settle(heat));
    } else if (strcmp(c, "heat_step") == 0 && n == 1) {
        check(cagedyn_heat_step(heat, scalar_of(args[0])));
    } else if (strcmp(c, "heat_temperatures") == 0) {
        *out = column(lumps);
        check(cagedyn_heat_temperatures(heat, mxGetPr(*out), lumps));
    } else if (strcmp(c, "heat_set_temperatures") == 0 && n == 1) {
        const double *temperatures = numbers_of(args[0], &length);
        check(cagedyn_heat_set_temperatures(heat, temperatures, length));
    } else if (strcmp(c, "heat_into_lumps") == 0) {
        *out = column(lumps);
        check(cagedyn_heat_into_lumps(heat, mxGetPr(*out), lumps));
    } else if (strcmp(c, "heat_flows") == 0) {
        *out = column(links);
        check(cagedyn_heat_flows(heat, mxGetPr(*out), links));
    } else if (strcmp(c, "heat_of_sources") == 0) {
        *out = column(sources);
        check(cagedyn_heat_sources(heat, mxGetPr(*out), sources));
    } else if (strcmp(c, "heat_quantities") == 0) {
        mxArray *values = column(quantities);
        check(cagedyn_heat_quantities(heat, mxGetPr(values), quantities));
        *out = named(quantities, cagedyn_heat_quantity_name, mxGetPr(values));
    } else {
        return 0;
    }
    return 1;
}

/* Commands on a simulation. `n` is the number of arguments after it. */
static int sim_command(const char *c, object *o, int n, const mxArray **args, mxArray **out)
{
    cagedyn_sim *sim = (cagedyn_sim *)o->pointer;
    int64_t length = 0;
    const double *x;
    mxArray *values;
    if (strcmp(c, "time") == 0) {
        *out = column(1);
        check(cagedyn_sim_time(sim, mxGetPr(*out)));
    } else if (strcmp(c, "state") == 0) {
        *out = column(o->states);
        check(cagedyn_sim_get_state(sim, mxGetPr(*out), o->states));
    } else if (strcmp(c, "set_state") == 0 && n == 2) {
        x = numbers_of(args[1], &length);
        check(cagedyn_sim_set_state(sim, scalar_of(args[0]), x, length));
    } else if (strcmp(c, "reset") == 0) {
        check(cagedyn_sim_reset(sim));
    } else if (strcmp(c, "advance") == 0 && n == 2) {
        /* To a time, for so many seconds of wall time; whether it has come there. */
        int32_t status;
        check(cagedyn_sim_set_wall_time_limit(sim, scalar_of(args[1])));
        status = cagedyn_sim_advance_to(sim, scalar_of(args[0]));
        if (status != CAGEDYN_ERR_OUT_OF_TIME) check(status);
        *out = mxCreateLogicalScalar(status == CAGEDYN_OK);
    } else if (strcmp(c, "cancel") == 0) {
        cagedyn_canceller *canceller = cagedyn_canceller_new(sim);
        int32_t status = cagedyn_canceller_cancel(canceller);
        cagedyn_canceller_free(canceller);
        check(status);
    } else if (strcmp(c, "save") == 0) {
        length = cagedyn_sim_save_length(sim);
        if (length < 0) fail();
        *out = column(length);
        check(cagedyn_sim_save(sim, mxGetPr(*out), length));
    } else if (strcmp(c, "restore") == 0 && n == 1) {
        x = numbers_of(args[0], &length);
        check(cagedyn_sim_restore(sim, x, length));
    } else if (strcmp(c, "statistics") == 0) {
        values = column(cagedyn_statistic_count());
        check(cagedyn_sim_statistics(sim, mxGetPr(values), cagedyn_statistic_count()));
        *out = named(cagedyn_statistic_count(), cagedyn_statistic_name, mxGetPr(values));
    } else if (strcmp(c, "law_evaluations") == 0) {
        values = column(cagedyn_law_count());
        check(cagedyn_sim_law_evaluations(sim, mxGetPr(values), cagedyn_law_count()));
        *out = named(cagedyn_law_count(), cagedyn_law_name, mxGetPr(values));
    } else if (strcmp(c, "power_balance") == 0) {
        values = column(cagedyn_balance_count());
        check(cagedyn_sim_power_balance(sim, mxGetPr(values), cagedyn_balance_count()));
        *out = named(cagedyn_balance_count(), cagedyn_balance_name, mxGetPr(values));
    } else if (strcmp(c, "outputs") == 0) {
        *out = column(o->outputs);
        check(cagedyn_sim_get_outputs(sim, mxGetPr(*out), o->outputs));
    } else if (strcmp(c, "outputs_at") == 0 && n == 2) {
        x = numbers_of(args[1], &length);
        *out = column(o->outputs);
        check(cagedyn_sim_outputs_at(sim, scalar_of(args[0]), x, length, mxGetPr(*out), o->outputs));
    } else if (strcmp(c, "input") == 0 && n == 1) {
        *out = column(1);
        check(cagedyn_sim_get_input(sim, (int64_t)scalar_of(args[0]) - 1, mxGetPr(*out)));
    } else if (strcmp(c, "set_input") == 0 && n == 2) {
        check(cagedyn_sim_set_input(sim, (int64_t)scalar_of(args[0]) - 1, scalar_of(args[1])));
    } else if (strcmp(c, "set_input_slope") == 0 && n == 3) {
        check(cagedyn_sim_set_input_slope(sim, (int64_t)scalar_of(args[0]) - 1, scalar_of(args[1]), scalar_of(args[2])));
    } else if (strcmp(c, "release_input") == 0 && n == 1) {
        check(cagedyn_sim_release_input(sim, (int64_t)scalar_of(args[0]) - 1));
    } else if (strcmp(c, "derivative") == 0 && n == 2) {
        x = numbers_of(args[1], &length);
        *out = column(length);
        check(cagedyn_sim_derivative(sim, scalar_of(args[0]), x, mxGetPr(*out), length));
    } else if (strcmp(c, "jacobian") == 0 && n == 3) {
        x = numbers_of(args[1], &length);
        *out = jacobian(o, object_of(args[2], MODEL), scalar_of(args[0]), x, length);
    } else if (strcmp(c, "input_jacobian") == 0 && n == 3) {
        x = numbers_of(args[1], &length);
        int64_t inputs = cagedyn_model_input_count((cagedyn_model *)object_of(args[2], MODEL)->pointer);
        *out = mxCreateDoubleMatrix((mwSize)length, (mwSize)inputs, mxREAL);
        check(cagedyn_sim_input_jacobian(sim, scalar_of(args[0]), x, length, mxGetPr(*out), length * inputs));
    } else if (strcmp(c, "output_jacobian") == 0 && n == 3) {
        /* Over states, and behind them over inputs. */
        x = numbers_of(args[1], &length);
        int64_t inputs = cagedyn_model_input_count((cagedyn_model *)object_of(args[2], MODEL)->pointer);
        *out = mxCreateDoubleMatrix((mwSize)o->outputs, (mwSize)(length + inputs), mxREAL);
        check(cagedyn_sim_output_jacobian(sim, scalar_of(args[0]), x, length, mxGetPr(*out), o->outputs * length,
                                          mxGetPr(*out) + o->outputs * length, o->outputs * inputs));
    } else if (strcmp(c, "contact_forces") == 0) {
        /* One column per contact, one row per quantity. */
        *out = mxCreateDoubleMatrix((mwSize)o->quantities, (mwSize)o->contacts, mxREAL);
        check(cagedyn_sim_contact_forces(sim, mxGetPr(*out), o->quantities * o->contacts));
    } else if (strcmp(c, "body_forces") == 0) {
        /* Components, sources, bodies. */
        mwSize sizes[3];
        sizes[0] = (mwSize)o->components, sizes[1] = (mwSize)o->sources, sizes[2] = (mwSize)o->bodies;
        *out = mxCreateNumericArray(3, sizes, mxDOUBLE_CLASS, mxREAL);
        check(cagedyn_sim_body_forces(sim, mxGetPr(*out), o->components * o->sources * o->bodies));
    } else if (strcmp(c, "doubts") == 0) {
        int32_t status = cagedyn_sim_trust(sim);
        if (status != CAGEDYN_ERR_UNTRUSTED && status != CAGEDYN_ERR_NOT_JUDGED) check(status);
        *out = mxCreateString(status == CAGEDYN_OK ? "" : cagedyn_error_message());
    } else if (strcmp(c, "report") == 0) {
        *out = mxCreateString(cagedyn_sim_report(sim));
    } else {
        return 0;
    }
    return 1;
}

void mexFunction(int nlhs, mxArray *plhs[], int nrhs, const mxArray *prhs[])
{
    char command[32];
    (void)nlhs;
    mexAtExit(release_all);
    if (nrhs < 1 || mxGetString(prhs[0], command, sizeof command) != 0) refuse("cagedyn_mex(command, ...)");
    if (strcmp(command, "version") == 0) {
        plhs[0] = mxCreateString(cagedyn_version());
    } else if (nrhs < 2) {
        refuse("this command needs more arguments, or there is none of this name");
    } else if (strcmp(command, "model") == 0) {
        new_model(nrhs - 1, prhs + 1, plhs);
    } else if (strcmp(command, "sim") == 0) {
        new_sim(nrhs - 1, prhs + 1, plhs);
    } else if (strcmp(command, "batch") == 0) {
        new_batch(prhs[1], plhs);
    } else if (strcmp(command, "heat") == 0) {
        cagedyn_heat *heat = cagedyn_heat_new((cagedyn_model *)object_of(prhs[1], MODEL)->pointer);
        if (heat == NULL) fail();
        new_object(HEAT, heat, plhs);
    } else if (strcmp(command, "whirl") == 0) {
        plhs[0] = whirl((cagedyn_model *)object_of(prhs[1], MODEL)->pointer, nrhs - 2, prhs + 2);
    } else if (strcmp(command, "free_model") == 0) {
        release(object_of(prhs[1], MODEL));
    } else if (strcmp(command, "feedthrough_pattern") == 0) {
        plhs[0] = feedthrough(object_of(prhs[1], MODEL));
    } else if (strcmp(command, "free_sim") == 0) {
        release(object_of(prhs[1], SIM));
    } else if (strcmp(command, "free_batch") == 0) {
        release(object_of(prhs[1], BATCH));
    } else if (strcmp(command, "free_heat") == 0) {
        release(object_of(prhs[1], HEAT));
    } else if (strcmp(command, "names") == 0 && nrhs == 4) {
        char *kind_name = text_of(prhs[2]), *what = text_of(prhs[3]);
        plhs[0] = names((cagedyn_model *)object_of(prhs[1], MODEL)->pointer, kind_name, what);
        mxFree(kind_name);
        mxFree(what);
    } else if (strcmp(command, "geometry") == 0 && nrhs == 3) {
        plhs[0] = column(1);
        check(cagedyn_model_get_geometry((cagedyn_model *)object_of(prhs[1], MODEL)->pointer,
                                         (int64_t)scalar_of(prhs[2]) - 1, mxGetPr(plhs[0])));
    } else if (strncmp(command, "batch_", 6) == 0
                   ? !batch_command(command, object_of(prhs[1], BATCH), nrhs - 2, prhs + 2, plhs)
               : strncmp(command, "heat_", 5) == 0
                   ? !heat_command(command, object_of(prhs[1], HEAT), nrhs - 2, prhs + 2, plhs)
                   : !sim_command(command, object_of(prhs[1], SIM), nrhs - 2, prhs + 2, plhs)) {
        refuse("there is no such command, or it has other arguments");
    }
}
