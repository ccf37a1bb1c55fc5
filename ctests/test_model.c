/* Creation and introspection of models. */
#include "check.h"

typedef const char *(*text_fn)(const cagedyn_model *, int64_t);
typedef int64_t (*find_fn)(const cagedyn_model *, const char *);

/* Every name is found again, and every text exists. */
static void check_list(const cagedyn_model *m, int64_t count, text_fn name, text_fn unit, text_fn description,
                       find_fn find)
{
    CHECK(count > 0);
    for (int64_t i = 0; i < count; i++) {
        CHECK(name(m, i)[0] != '\0');
        CHECK(find(m, name(m, i)) == i);
        if (unit != NULL) CHECK(unit(m, i)[0] != '\0');
        if (description != NULL) CHECK(description(m, i)[0] != '\0');
    }
    CHECK(name(m, count)[0] == '\0');
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_BAD_INDEX);
    CHECK(name(m, -1)[0] == '\0');
    CHECK_FAILS(find(m, "no such name"), CAGEDYN_ERR_UNKNOWN_NAME, "no such name");
    CHECK_FAILS(find(m, NULL), CAGEDYN_ERR_NULL_ARGUMENT, "name");
    CHECK_FAILS(find(NULL, "x"), CAGEDYN_ERR_NULL_ARGUMENT, "model");
}

static void check_introspection(const cagedyn_model *m)
{
    check_list(m, cagedyn_model_state_count(m), cagedyn_model_state_name, cagedyn_model_state_unit,
               cagedyn_model_state_description, cagedyn_model_find_state);
    check_list(m, cagedyn_model_input_count(m), cagedyn_model_input_name, cagedyn_model_input_unit,
               cagedyn_model_input_description, cagedyn_model_find_input);
    check_list(m, cagedyn_model_output_count(m), cagedyn_model_output_name, cagedyn_model_output_unit,
               cagedyn_model_output_description, cagedyn_model_find_output);
    check_list(m, cagedyn_model_contact_count(m), cagedyn_model_contact_name, NULL, NULL,
               cagedyn_model_find_contact);
    check_list(m, cagedyn_model_contact_quantity_count(m), cagedyn_model_contact_quantity_name,
               cagedyn_model_contact_quantity_unit, cagedyn_model_contact_quantity_description,
               cagedyn_model_find_contact_quantity);
    check_list(m, cagedyn_model_body_count(m), cagedyn_model_body_name, NULL, NULL, cagedyn_model_find_body);
    check_list(m, cagedyn_model_force_source_count(m), cagedyn_model_force_source_name, NULL, NULL,
               cagedyn_model_find_force_source);
    check_list(m, cagedyn_model_force_component_count(m), cagedyn_model_force_component_name,
               cagedyn_model_force_component_unit, cagedyn_model_force_component_description,
               cagedyn_model_find_force_component);
}

static void check_counts(const cagedyn_model *m)
{
    /* Ring 2, cage 3, twelve rollers 2 positions and 3 velocities each. */
    CHECK(cagedyn_model_position_count(m) == 29);
    CHECK(cagedyn_model_velocity_count(m) == 41);
    CHECK(cagedyn_model_state_count(m) == 70);
    CHECK(cagedyn_model_input_count(m) == 3);
    CHECK(cagedyn_model_contact_count(m) == 48);
    CHECK(cagedyn_model_body_count(m) == 15);
    CHECK(cagedyn_model_find_state(m, "cage.y") == 2);
    CHECK(cagedyn_model_find_body(m, "inner_ring") == 1);
}

static void check_overrides(const cagedyn_model *m)
{
    const char *json = cagedyn_model_scene_json(m);
    CHECK(strstr(json, "cagedyn.scene/1") != NULL);
    cagedyn_model *copy = cagedyn_model_from_json(json);
    CHECK(copy != NULL);
    CHECK(strcmp(cagedyn_model_scene_json(copy), json) == 0);
    cagedyn_model_free(copy);

    cagedyn_model *small = cagedyn_model_from_json_with(json, "rollers.count = 6\n\ncage.guide=null\n");
    CHECK(small != NULL);
    CHECK(cagedyn_model_state_count(small) == 2 + 3 + 12 + 2 + 3 + 18);
    CHECK(cagedyn_model_find_output(small, "guide.moment") == CAGEDYN_ERR_UNKNOWN_NAME);
    cagedyn_model_free(small);

    CHECK(cagedyn_model_from_json_with(json, "rollers.count") == NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_BAD_VALUE);
    CHECK(cagedyn_model_from_json_with(json, "rollers.size=3") == NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_BAD_JSON);
    CHECK(cagedyn_model_from_json_with(json, "wheels.count=3") == NULL);
    CHECK(cagedyn_error_status() == CAGEDYN_ERR_UNKNOWN_NAME);
}

int main(int argc, char **argv)
{
    cagedyn_model *model = load_model(argc, argv);
    char version[32];
    snprintf(version, sizeof version, "%d.%d.%d", CAGEDYN_VERSION_MAJOR, CAGEDYN_VERSION_MINOR,
             CAGEDYN_VERSION_PATCH);
    CHECK(strcmp(version, cagedyn_version()) == 0);
    check_introspection(model);
    check_counts(model);
    check_overrides(model);
    cagedyn_model_free(model);
    cagedyn_model_free(NULL);
    return failures != 0;
}
