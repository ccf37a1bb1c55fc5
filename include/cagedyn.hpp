// cagedyn for C++17 and later: owning handles, exceptions, vectors and views over the C interface in cagedyn.h, which says what
// each function does, in which units, and how it can fail.
//
// Handles   Model, Sim, Batch, Monitor and Canceller own what they hold, can be moved and not copied. SimRef is a simulation that
//           somebody else owns, such as a batch.
// Errors    A call that fails throws cagedyn::Error, with status(), name() and what(). Without exceptions (-fno-exceptions, or
//           CAGEDYN_NO_EXCEPTIONS defined) it does not: handles are then empty, numbers are zero or negative, vectors hold zeros,
//           and cagedyn::last_status() and last_message() tell of the last call in this thread.
// Arrays    What takes numbers takes std::vector, std::array, arrays, a pointer with a length, and std::span where there is one.
//           What gives numbers returns std::vector; given an array to write to it allocates nothing. Lengths must be exactly
//           those of the model.
// Names     std::string_view of text that lives as long as the model, or for ever where no model is asked.

#ifndef CAGEDYN_HPP
#define CAGEDYN_HPP

#include "cagedyn.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#if !defined(CAGEDYN_NO_EXCEPTIONS) && !defined(__cpp_exceptions) && !defined(_CPPUNWIND)
#define CAGEDYN_NO_EXCEPTIONS
#endif
#ifndef CAGEDYN_NO_EXCEPTIONS
#include <stdexcept>
#endif

namespace cagedyn {

// Status of the last call in this thread that can fail; CAGEDYN_OK after a success.
inline std::int32_t last_status() noexcept { return cagedyn_error_status(); }

// Message of that call; empty after a success. The next call in this thread overwrites it.
inline std::string_view last_message() noexcept { return cagedyn_error_message(); }

// Version of the library that is linked.
inline std::string_view version() noexcept { return cagedyn_version(); }

#ifndef CAGEDYN_NO_EXCEPTIONS
// A call that failed.
class Error : public std::runtime_error {
public:
    Error(std::int32_t status, const char *message) : std::runtime_error(message), status_(status) {}
    // CAGEDYN_ERR_ code.
    std::int32_t status() const noexcept { return status_; }
    // Its name, for example "ERR_BAD_SCENE".
    std::string_view name() const noexcept { return cagedyn_status_name(status_); }

private:
    std::int32_t status_;
};
#endif

// How accurate a simulation is to be where its scene leaves that open.
enum class Preset : std::int32_t {
    draft = CAGEDYN_PRESET_DRAFT,
    engineering = CAGEDYN_PRESET_ENGINEERING,
    reference = CAGEDYN_PRESET_REFERENCE
};

// A text that ends with NUL.
class Text {
public:
    Text(const char *text) noexcept : text_(text) {}
    Text(const std::string &text) noexcept : text_(text.c_str()) {}
    // A copy, as a view may end without NUL.
    Text(std::string_view text) : copy_(text), copied_(true) {}
    const char *c_str() const noexcept { return copied_ ? copy_.c_str() : text_; }

private:
    const char *text_ = nullptr;
    std::string copy_;
    bool copied_ = false;
};

// Numbers somewhere: `const double` to be read, `double` to be written.
template <class T> class View {
public:
    View(T *data, std::size_t size) noexcept : data_(data), size_(static_cast<std::int64_t>(size)) {}
    template <std::size_t N> View(T (&array)[N]) noexcept : View(array, N) {}
    // std::vector, std::array, std::span and whatever else has data() and size().
    template <class C, class = std::enable_if_t<std::is_convertible_v<decltype(std::declval<C &>().data()), T *>>>
    View(C &&numbers) noexcept : View(numbers.data(), numbers.size()) {}
    T *data() const noexcept { return data_; }
    std::int64_t size() const noexcept { return size_; }

private:
    T *data_;
    std::int64_t size_;
};

using Input = View<const double>;
using Output = View<double>;

namespace detail {

inline void check([[maybe_unused]] std::int32_t status)
{
#ifndef CAGEDYN_NO_EXCEPTIONS
    if (status != CAGEDYN_OK) throw Error(status, cagedyn_error_message());
#endif
}

inline void fail([[maybe_unused]] std::int32_t status, [[maybe_unused]] const char *message)
{
#ifndef CAGEDYN_NO_EXCEPTIONS
    throw Error(status, message);
#endif
}

inline std::int64_t counted(std::int64_t count)
{
    if (count < 0) check(static_cast<std::int32_t>(count));
    return count;
}

template <class T> T *made(T *handle)
{
    if (handle == nullptr) check(cagedyn_error_status());
    return handle;
}

inline const char *told(const char *text)
{
    if (*text == '\0') check(cagedyn_error_status());
    return text;
}

template <auto Free> struct Deleter {
    template <class T> void operator()(T *handle) const noexcept { Free(handle); }
};

// Numbers of short lists, which may grow behind those that are there, but not beyond this.
constexpr std::size_t room = 64;

inline std::vector<double> zeros(std::int64_t count)
{
    return std::vector<double>(count > 0 ? static_cast<std::size_t>(count) : 0);
}

} // namespace detail

// A list of named things of a model: functions of cagedyn.h under one name.
template <auto Count, auto Name, auto Find, auto Unit = nullptr, auto Description = nullptr> class Items {
public:
    explicit Items(const cagedyn_model *model) noexcept : model_(model) {}
    std::int64_t size() const { return detail::counted(Count(model_)); }
    std::string_view name(std::int64_t index) const { return detail::told(Name(model_, index)); }
    // Index of the item of this name.
    std::int64_t find(Text name) const { return detail::counted(Find(model_, name.c_str())); }
    // Whether there is an item of this name.
    bool has(Text name) const noexcept { return Find(model_, name.c_str()) >= 0; }
    std::string_view unit(std::int64_t index) const
    {
        static_assert(!std::is_null_pointer_v<decltype(Unit)>, "these have no unit");
        return detail::told(Unit(model_, index));
    }
    std::string_view description(std::int64_t index) const
    {
        static_assert(!std::is_null_pointer_v<decltype(Description)>, "these have no description");
        return detail::told(Description(model_, index));
    }
    std::vector<std::string_view> names() const
    {
        std::vector<std::string_view> names;
        for (std::int64_t i = 0, n = size(); i < n; i++) names.push_back(name(i));
        return names;
    }

private:
    const cagedyn_model *model_;
};

using States = Items<cagedyn_model_state_count, cagedyn_model_state_name, cagedyn_model_find_state,
                     cagedyn_model_state_unit, cagedyn_model_state_description>;
using Inputs = Items<cagedyn_model_input_count, cagedyn_model_input_name, cagedyn_model_find_input,
                     cagedyn_model_input_unit, cagedyn_model_input_description>;
using Outputs = Items<cagedyn_model_output_count, cagedyn_model_output_name, cagedyn_model_find_output,
                      cagedyn_model_output_unit, cagedyn_model_output_description>;
using Contacts = Items<cagedyn_model_contact_count, cagedyn_model_contact_name, cagedyn_model_find_contact>;
using ContactQuantities =
    Items<cagedyn_model_contact_quantity_count, cagedyn_model_contact_quantity_name,
          cagedyn_model_find_contact_quantity, cagedyn_model_contact_quantity_unit,
          cagedyn_model_contact_quantity_description>;
using LineLoadQuantities =
    Items<cagedyn_model_line_load_quantity_count, cagedyn_model_line_load_quantity_name,
          cagedyn_model_find_line_load_quantity, cagedyn_model_line_load_quantity_unit,
          cagedyn_model_line_load_quantity_description>;
using Bodies = Items<cagedyn_model_body_count, cagedyn_model_body_name, cagedyn_model_find_body>;
using ForceSources =
    Items<cagedyn_model_force_source_count, cagedyn_model_force_source_name, cagedyn_model_find_force_source>;
using ForceComponents = Items<cagedyn_model_force_component_count, cagedyn_model_force_component_name,
                              cagedyn_model_find_force_component, cagedyn_model_force_component_unit,
                              cagedyn_model_force_component_description>;
using Geometry = Items<cagedyn_model_geometry_count, cagedyn_model_geometry_name, cagedyn_model_find_geometry,
                       cagedyn_model_geometry_unit, cagedyn_model_geometry_description>;

// Where a sparse Jacobian can be other than zero: compressed sparse columns, counted from 0.
struct JacobianPattern {
    std::vector<std::int64_t> column_starts;
    std::vector<std::int64_t> rows;
};

// A compiled scene. May be used from several threads at a time.
class Model {
public:
    // No model.
    Model() noexcept = default;
    // Takes over a handle of cagedyn.h.
    explicit Model(cagedyn_model *handle) noexcept : handle_(handle) {}
    static Model from_json(Text json) { return Model(detail::made(cagedyn_model_from_json(json.c_str()))); }
    // With one replacement "path=value" per line of `overrides`.
    static Model from_json(Text json, Text overrides)
    {
        return Model(detail::made(cagedyn_model_from_json_with(json.c_str(), overrides.c_str())));
    }
    static Model from_file(Text path) { return Model(detail::made(cagedyn_model_from_file(path.c_str()))); }

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    const cagedyn_model *get() const noexcept { return handle_.get(); }

    // The scene with its replacements.
    std::string_view scene_json() const { return detail::told(cagedyn_model_scene_json(get())); }
    // Values of the scene that are legal and unlikely, one line each.
    std::vector<std::string_view> warnings() const
    {
        std::vector<std::string_view> lines;
        for (std::int64_t i = 0, n = detail::counted(cagedyn_model_warning_count(get())); i < n; i++)
            lines.push_back(cagedyn_model_warning(get(), i));
        return lines;
    }
    std::int64_t position_count() const { return detail::counted(cagedyn_model_position_count(get())); }
    std::int64_t velocity_count() const { return detail::counted(cagedyn_model_velocity_count(get())); }
    States states() const noexcept { return States(get()); }
    Inputs inputs() const noexcept { return Inputs(get()); }
    Outputs outputs() const noexcept { return Outputs(get()); }
    Contacts contacts() const noexcept { return Contacts(get()); }
    ContactQuantities contact_quantities() const noexcept { return ContactQuantities(get()); }
    LineLoadQuantities line_load_quantities() const noexcept { return LineLoadQuantities(get()); }
    Bodies bodies() const noexcept { return Bodies(get()); }
    ForceSources force_sources() const noexcept { return ForceSources(get()); }
    ForceComponents force_components() const noexcept { return ForceComponents(get()); }
    Geometry geometry() const noexcept { return Geometry(get()); }
    // A length or count of the bearing by its name, for example "pitch_radius" in m.
    double geometry(Text name) const
    {
        double value = 0.0;
        detail::check(cagedyn_model_get_geometry(get(), geometry().find(name), &value));
        return value;
    }
    // Outputs that are watched in every step.
    std::vector<std::int64_t> watched() const
    {
        std::vector<std::int64_t> outputs;
        for (std::int64_t i = 0, n = detail::counted(cagedyn_model_watched_count(get())); i < n; i++)
            outputs.push_back(cagedyn_model_watched_output(get(), i));
        return outputs;
    }
    JacobianPattern jacobian_pattern() const
    {
        return pattern(states().size(), cagedyn_model_jacobian_entry_count(get()), cagedyn_model_jacobian_pattern);
    }
    // Which outputs (rows) may change at once with which inputs (columns).
    JacobianPattern feedthrough_pattern() const
    {
        return pattern(inputs().size(), cagedyn_model_feedthrough_entry_count(get()), cagedyn_model_feedthrough_pattern);
    }

private:
    template <class Columns, class Write>
    JacobianPattern pattern(Columns columns, std::int64_t entries, Write write) const
    {
        JacobianPattern pattern;
        pattern.column_starts.resize(static_cast<std::size_t>(columns) + 1);
        pattern.rows.resize(static_cast<std::size_t>(detail::counted(entries)));
        detail::check(write(get(), pattern.column_starts.data(), static_cast<std::int64_t>(pattern.column_starts.size()),
                            pattern.rows.data(), static_cast<std::int64_t>(pattern.rows.size())));
        return pattern;
    }

    std::unique_ptr<cagedyn_model, detail::Deleter<cagedyn_model_free>> handle_;
};

// Stops one simulation from any thread.
class Canceller {
public:
    explicit Canceller(cagedyn_canceller *handle) noexcept : handle_(handle) {}
    explicit operator bool() const noexcept { return handle_ != nullptr; }
    void cancel() const { detail::check(cagedyn_canceller_cancel(handle_.get())); }

private:
    std::unique_ptr<cagedyn_canceller, detail::Deleter<cagedyn_canceller_free>> handle_;
};

// What a watched output did in an interval, in its unit and in s.
struct Interval {
    double from, to, min, max, mean, integral, positive_integral;
};

// Energies of a state, J.
struct Energies {
    double kinetic, elastic, potential;
};

// A simulation that somebody else owns.
class SimRef {
public:
    // Of a handle of cagedyn.h, made from this model.
    SimRef(cagedyn_sim *handle, const cagedyn_model *model)
        : sim_(handle), states_(cagedyn_model_state_count(model)), velocities_(cagedyn_model_velocity_count(model)),
          outputs_(cagedyn_model_output_count(model)),
          contacts_(cagedyn_model_contact_count(model) * cagedyn_model_contact_quantity_count(model)),
          line_load_columns_(cagedyn_model_line_load_quantity_count(model)),
          bodies_(cagedyn_model_body_count(model) * cagedyn_model_force_source_count(model) *
                  cagedyn_model_force_component_count(model))
    {
    }

    explicit operator bool() const noexcept { return sim_ != nullptr; }
    cagedyn_sim *get() const noexcept { return sim_; }

    // Simulated time, s.
    double time() const
    {
        double time = 0.0;
        detail::check(cagedyn_sim_time(sim_, &time));
        return time;
    }
    std::vector<double> state() const { return filled(states_, [this](Output out) { state(out); }); }
    void state(Output out) const { detail::check(cagedyn_sim_get_state(sim_, out.data(), out.size())); }
    void set_state(double time, Input state)
    {
        detail::check(cagedyn_sim_set_state(sim_, time, state.data(), state.size()));
    }
    void reset() { detail::check(cagedyn_sim_reset(sim_)); }
    void step(double dt) { detail::check(cagedyn_sim_step(sim_, dt)); }
    void advance_to(double t) { detail::check(cagedyn_sim_advance_to(sim_, t)); }

    std::vector<double> outputs() { return filled(outputs_, [this](Output out) { outputs(out); }); }
    void outputs(Output out) { detail::check(cagedyn_sim_get_outputs(sim_, out.data(), out.size())); }
    double output(std::int64_t index)
    {
        double value = 0.0;
        detail::check(cagedyn_sim_get_output(sim_, index, &value));
        return value;
    }
    double input(std::int64_t index) const
    {
        double value = 0.0;
        detail::check(cagedyn_sim_get_input(sim_, index, &value));
        return value;
    }
    void set_input(std::int64_t index, double value)
    {
        detail::check(cagedyn_sim_set_input(sim_, index, value));
    }
    // The input goes on from the value with this slope per second.
    void set_input_slope(std::int64_t index, double value, double slope)
    {
        detail::check(cagedyn_sim_set_input_slope(sim_, index, value, slope));
    }
    void release_input(std::int64_t index) { detail::check(cagedyn_sim_release_input(sim_, index)); }

    std::vector<double> accelerations() { return filled(velocities_, [this](Output out) { accelerations(out); }); }
    void accelerations(Output out) { detail::check(cagedyn_sim_accelerations(sim_, out.data(), out.size())); }
    // One row per contact, one column per contact quantity.
    std::vector<double> contact_forces() { return filled(contacts_, [this](Output out) { contact_forces(out); }); }
    void contact_forces(Output out) { detail::check(cagedyn_sim_contact_forces(sim_, out.data(), out.size())); }
    // How a contact of a roller in space is loaded along it: one row per place, one column per line load quantity.
    std::vector<double> line_loads(std::int64_t contact)
    {
        const std::int64_t rows = detail::counted(cagedyn_sim_line_load_count(sim_, contact));
        return filled(rows * line_load_columns_, [this, contact](Output out) {
            detail::check(cagedyn_sim_line_loads(sim_, contact, out.data(), out.size()));
        });
    }
    // Per body a block with one row per force source, one column per force component.
    std::vector<double> body_forces() { return filled(bodies_, [this](Output out) { body_forces(out); }); }
    void body_forces(Output out) { detail::check(cagedyn_sim_body_forces(sim_, out.data(), out.size())); }

    void begin_interval() { detail::check(cagedyn_sim_begin_interval(sim_)); }
    // Of a watched output since begin_interval().
    Interval interval(std::int64_t output)
    {
        double x[detail::room] = {};
        detail::check(cagedyn_sim_get_interval(sim_, output, x, cagedyn_interval_count()));
        return {x[0], x[1], x[2], x[3], x[4], x[5], x[6]};
    }

    std::vector<double> save() const
    {
        return filled(detail::counted(cagedyn_sim_save_length(sim_)), [this](Output out) {
            detail::check(cagedyn_sim_save(sim_, out.data(), out.size()));
        });
    }
    void restore(Input saved) { detail::check(cagedyn_sim_restore(sim_, saved.data(), saved.size())); }

    Canceller canceller() const { return Canceller(detail::made(cagedyn_canceller_new(sim_))); }
    void set_wall_time_limit(double seconds) { detail::check(cagedyn_sim_set_wall_time_limit(sim_, seconds)); }

    // Whether the run kept what its preset promises; last_message() says why not, or why that cannot be known.
    bool trusted()
    {
        std::int32_t status = cagedyn_sim_trust(sim_);
        if (status != CAGEDYN_ERR_UNTRUSTED && status != CAGEDYN_ERR_NOT_JUDGED) detail::check(status);
        return status == CAGEDYN_OK;
    }
    // Whether it can be known: false where set_state moved the run on the way and nothing else speaks against it.
    bool judged()
    {
        std::int32_t status = cagedyn_sim_trust(sim_);
        if (status == CAGEDYN_ERR_NOT_JUDGED) return false;
        if (status != CAGEDYN_ERR_UNTRUSTED) detail::check(status);
        return true;
    }
    // One line for people. Lives until the next call for this simulation.
    std::string_view report() { return detail::told(cagedyn_sim_report(sim_)); }
    // In the order of cagedyn_statistic_name().
    std::vector<double> statistics() const
    {
        return filled(cagedyn_statistic_count(), [this](Output out) {
            detail::check(cagedyn_sim_statistics(sim_, out.data(), out.size()));
        });
    }
    // In the order of cagedyn_law_name().
    std::vector<double> law_evaluations() const
    {
        return filled(cagedyn_law_count(), [this](Output out) {
            detail::check(cagedyn_sim_law_evaluations(sim_, out.data(), out.size()));
        });
    }
    // In the order of cagedyn_balance_name().
    std::vector<double> power_balance()
    {
        return filled(cagedyn_balance_count(), [this](Output out) {
            detail::check(cagedyn_sim_power_balance(sim_, out.data(), out.size()));
        });
    }

    // For hosts with their own integrator: at any time and state.
    void derivative(double t, Input state, Output rate)
    {
        detail::check(cagedyn_sim_derivative(sim_, t, state.data(), rate.data(), same(state, rate)));
    }
    void time_derivative(double t, Input state, Output rate)
    {
        detail::check(cagedyn_sim_time_derivative(sim_, t, state.data(), rate.data(), same(state, rate)));
    }
    // By columns.
    void jacobian(double t, Input state, Output out)
    {
        detail::check(cagedyn_sim_jacobian(sim_, t, state.data(), state.size(), out.data(), out.size()));
    }
    // Of the rates over the inputs, and of the outputs over states and inputs; by columns.
    void input_jacobian(double t, Input state, Output out)
    {
        detail::check(cagedyn_sim_input_jacobian(sim_, t, state.data(), state.size(), out.data(), out.size()));
    }
    void output_jacobian(double t, Input state, Output over_states, Output over_inputs)
    {
        detail::check(cagedyn_sim_output_jacobian(sim_, t, state.data(), state.size(), over_states.data(),
                                                  over_states.size(), over_inputs.data(), over_inputs.size()));
    }
    // The first jump or kink of an input after t; infinity without one.
    double next_event(double t)
    {
        double event = 0.0;
        detail::check(cagedyn_sim_next_event(sim_, t, &event));
        return event;
    }
    // In the order of Model::jacobian_pattern().
    void sparse_jacobian(double t, Input state, Output values)
    {
        detail::check(
            cagedyn_sim_sparse_jacobian(sim_, t, state.data(), state.size(), values.data(), values.size()));
    }
    void linearize(double t, Input state)
    {
        detail::check(cagedyn_sim_linearize(sim_, t, state.data(), state.size()));
    }
    void factorize(double gamma) { detail::check(cagedyn_sim_factorize(sim_, gamma)); }
    void solve(Output x) { detail::check(cagedyn_sim_solve(sim_, x.data(), x.size())); }
    void contact_forces_at(double t, Input state, Output out)
    {
        detail::check(cagedyn_sim_contact_forces_at(sim_, t, state.data(), state.size(), out.data(), out.size()));
    }
    void body_forces_at(double t, Input state, Output out)
    {
        detail::check(cagedyn_sim_body_forces_at(sim_, t, state.data(), state.size(), out.data(), out.size()));
    }
    void outputs_at(double t, Input state, Output out)
    {
        detail::check(cagedyn_sim_outputs_at(sim_, t, state.data(), state.size(), out.data(), out.size()));
    }
    Energies energies_at(double t, Input state)
    {
        double x[detail::room] = {};
        detail::check(cagedyn_sim_energies_at(sim_, t, state.data(), state.size(), x, cagedyn_energy_count()));
        return {x[0], x[1], x[2]};
    }

protected:
    cagedyn_sim *release() noexcept { return std::exchange(sim_, nullptr); }

private:
    template <class F> static std::vector<double> filled(std::int64_t count, F &&fill)
    {
        std::vector<double> numbers = detail::zeros(count);
        fill(Output(numbers));
        return numbers;
    }
    // The library takes one length for both; a wrong one of either is refused there.
    static std::int64_t same(Input state, Output rate)
    {
        return state.size() == rate.size() ? state.size() : -1;
    }

    cagedyn_sim *sim_;
    std::int64_t states_, velocities_, outputs_, contacts_, line_load_columns_, bodies_;
};

// A running simulation. May be used by one thread at a time. It keeps what it needs of its model.
class Sim : public SimRef {
public:
    explicit Sim(const Model &model) : SimRef(detail::made(cagedyn_sim_new(some(model))), model.get()) {}
    Sim(const Model &model, Preset preset)
        : SimRef(detail::made(cagedyn_sim_new_with_preset(some(model), static_cast<std::int32_t>(preset))),
                 model.get())
    {
    }
    Sim(Sim &&other) noexcept : SimRef(other) { other.release(); }
    Sim &operator=(Sim &&other) noexcept
    {
        if (this != &other) {
            cagedyn_sim_free(get());
            SimRef::operator=(other);
            other.release();
        }
        return *this;
    }
    Sim(const Sim &) = delete;
    Sim &operator=(const Sim &) = delete;
    ~Sim() { cagedyn_sim_free(get()); }

private:
    friend class Batch;
    // That there is no model is an error of its own here.
    static const cagedyn_model *some(const Model &model)
    {
        if (!model) detail::counted(cagedyn_model_state_count(nullptr));
        return model.get();
    }
};

// Watches and stops a batch from any thread.
class Monitor {
public:
    // How many simulations do what, and the share of the way that is done.
    struct Progress {
        std::int64_t simulations, waiting, running, arrived, failed;
        double share;
    };

    explicit Monitor(cagedyn_monitor *handle) noexcept : handle_(handle) {}
    explicit operator bool() const noexcept { return handle_ != nullptr; }
    void cancel() const { detail::check(cagedyn_monitor_cancel(handle_.get())); }
    Progress progress() const
    {
        double x[detail::room] = {};
        detail::check(cagedyn_monitor_progress(handle_.get(), x, cagedyn_progress_count()));
        auto whole = [&x](int i) { return static_cast<std::int64_t>(x[i]); };
        return {whole(0), whole(1), whole(2), whole(3), whole(4), x[5]};
    }

private:
    std::unique_ptr<cagedyn_monitor, detail::Deleter<cagedyn_monitor_free>> handle_;
};

// Simulations that run at once, on all cores.
class Batch {
public:
    Batch() : handle_(detail::made(cagedyn_batch_new())) {}
    explicit operator bool() const noexcept { return handle_ != nullptr; }
    cagedyn_batch *get() const noexcept { return handle_.get(); }

    // Takes over a simulation and returns its place.
    std::int64_t add(Sim &&sim)
    {
        std::int64_t place = detail::counted(cagedyn_batch_add(get(), sim.get()));
        if (place >= 0) {
            sims_.push_back(sim);
            sim.release();
        }
        return place;
    }
    std::size_t size() const noexcept { return sims_.size(); }
    // The simulation at this place, which the batch owns. Not to be used while the batch runs.
    SimRef &operator[](std::size_t place) { return sims_[place]; }

    // Advances all to time t (s); false if some did not arrive, see status() and message(). Threads: 0 for all cores. A refused
    // argument throws.
    bool advance_to(double t, std::int64_t threads = 0)
    {
        const std::int32_t status = cagedyn_batch_advance_to(get(), t, threads);
        if (status == CAGEDYN_OK) return true;
        // Nothing ran unless a simulation has failed.
        const std::string message = cagedyn_error_message();
        if (status != CAGEDYN_ERR_BUSY) {
            for (std::size_t i = 0; i < sims_.size(); i++) {
                if (cagedyn_batch_status(get(), static_cast<std::int64_t>(i)) != CAGEDYN_OK) return false;
            }
        }
        detail::fail(status, message.c_str());
        return false;
    }
    // CAGEDYN_OK, or the code with which a simulation failed.
    std::int32_t status(std::size_t place) const
    {
        const std::int32_t status = cagedyn_batch_status(get(), static_cast<std::int64_t>(place));
        if (place >= sims_.size()) detail::check(status);
        return status;
    }
    std::string_view message(std::size_t place) const
    {
        return cagedyn_batch_message(get(), static_cast<std::int64_t>(place));
    }
    Monitor monitor() const { return Monitor(detail::made(cagedyn_monitor_new(get()))); }

private:
    std::unique_ptr<cagedyn_batch, detail::Deleter<cagedyn_batch_free>> handle_;
    std::vector<SimRef> sims_;
};

} // namespace cagedyn

#endif // CAGEDYN_HPP
