// cagedyn for C++17 and later, beside cagedyn.hpp, whose conventions hold here, too: steady whirl and equilibrium without time stepping, temperatures,
// and what a host's own records say of a motion. cagedyn.h says what each function does, in which units, and how it can fail.

#ifndef CAGEDYN_ANALYSIS_HPP
#define CAGEDYN_ANALYSIS_HPP

#include "cagedyn.hpp"

namespace cagedyn {

// Watches, limits and stops one search at a time, from any thread.
class Watch {
public:
    // Share of the way that is done, from 0 to 1, and how many whirls or bursts of motion there are.
    struct Progress {
        double share, found;
    };

    Watch() : handle_(detail::made(cagedyn_watch_new())) {}

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    cagedyn_watch *get() const noexcept { return handle_.get(); }

    // Ends the running search, or else the next one.
    void cancel() const { detail::check(cagedyn_watch_cancel(get())); }
    // Of searches that begin after this, s from now.
    void set_wall_time_limit(double seconds) { detail::check(cagedyn_watch_set_wall_time_limit(get(), seconds)); }
    Progress progress() const
    {
        double x[2] = {};
        detail::check(cagedyn_watch_progress(get(), x, 2));
        return {x[0], x[1]};
    }

private:
    std::unique_ptr<cagedyn_watch, detail::Deleter<cagedyn_watch_free>> handle_;
};

// A branch of steady whirls, from its start to where it ends.
class WhirlBranch {
public:
    // Numbers of cagedyn_whirl_quantity_name(): rad/s, m, rad, 1/s, rad/s.
    struct Point {
        double parameter, whirl_speed, eccentricity, lead, leading_rate, leading_frequency;
        std::int64_t arcs;
        bool stable, fold, hopf, grazed;
    };
    // Rate in 1/s and frequency in rad/s of a small disturbance.
    struct Eigenvalue {
        double rate, frequency;
    };

    // The one point of the model's scene.
    static WhirlBranch steady(const Model &model)
    {
        return WhirlBranch(detail::made(cagedyn_whirl_steady(model.get())));
    }
    static WhirlBranch steady(const Model &model, const Watch &watch)
    {
        return WhirlBranch(detail::made(cagedyn_whirl_steady_with_watch(model.get(), watch.get())));
    }
    // Over the number at this path of the scene.
    static WhirlBranch follow(const Model &model, Text path, double from, double to)
    {
        return WhirlBranch(detail::made(cagedyn_whirl_follow(model.get(), path.c_str(), from, to)));
    }
    // One that the watch ends has the points so far, unless there is none.
    static WhirlBranch follow(const Model &model, Text path, double from, double to, const Watch &watch)
    {
        return WhirlBranch(
            detail::made(cagedyn_whirl_follow_with_watch(model.get(), path.c_str(), from, to, watch.get())));
    }
    // Takes over a handle of cagedyn.h.
    explicit WhirlBranch(cagedyn_whirl *handle) noexcept : handle_(handle) {}

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    const cagedyn_whirl *get() const noexcept { return handle_.get(); }

    std::int64_t size() const { return detail::counted(cagedyn_whirl_point_count(get())); }
    Point point(std::int64_t index) const
    {
        double x[detail::room] = {};
        detail::check(cagedyn_whirl_point(get(), index, x, cagedyn_whirl_quantity_count()));
        return {x[0], x[1], x[2], x[3], x[4], x[5], static_cast<std::int64_t>(x[6]), x[7] != 0.0, x[8] != 0.0, x[9] != 0.0,
                x[10] != 0.0};
    }
    // Amplitudes of the waves of an elastic cage at a point, m, from order 2 on; none of a rigid one.
    std::vector<double> amplitudes(std::int64_t index) const
    {
        std::vector<double> out = detail::zeros(detail::counted(cagedyn_whirl_wave_count(get())));
        detail::check(cagedyn_whirl_amplitudes(get(), index, out.data(), static_cast<std::int64_t>(out.size())));
        return out;
    }
    // Of a point, the largest rate first.
    std::vector<Eigenvalue> eigenvalues(std::int64_t index) const
    {
        std::vector<double> rates = detail::zeros(detail::counted(cagedyn_whirl_eigenvalue_count(get())));
        std::vector<double> frequencies(rates.size());
        detail::check(cagedyn_whirl_eigenvalues(get(), index, rates.data(), frequencies.data(),
                                                static_cast<std::int64_t>(rates.size())));
        std::vector<Eigenvalue> values;
        for (std::size_t i = 0; i < rates.size(); i++) values.push_back({rates[i], frequencies[i]});
        return values;
    }
    // CAGEDYN_OK, or why a watch has ended it.
    std::int32_t status() const noexcept { return cagedyn_whirl_status(get()); }
    // "range", "length", "lost", "cancelled" or "out of time".
    std::string_view end() const { return detail::told(cagedyn_whirl_end(get())); }
    // Why it ends before its range does; empty where it does not. Lives as long as the branch.
    std::string_view why() const noexcept { return cagedyn_whirl_why(get()); }

private:
    std::unique_ptr<cagedyn_whirl, detail::Deleter<cagedyn_whirl_free>> handle_;
};

// Temperatures of a bearing whose scene has `heat`, and where its heat comes from and goes to. May be used by one thread at a time.
class HeatBalance {
public:
    // What the last burst of motion came to: cagedyn_heat_quantity_name(), in Pa s, m, rad/s, W and K.
    struct Quantities {
        double viscosity, radial_clearance, whirl_speed, bearing_torque_heat, heat_in_no_lump, carried, standard_error, bursts;
    };
    // Lumps that a link joins; -1 stands for the surroundings.
    struct Link {
        std::int64_t first, second;
    };

    explicit HeatBalance(const Model &model) : handle_(detail::made(cagedyn_heat_new(model.get()))) {}

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    cagedyn_heat *get() const noexcept { return handle_.get(); }

    // Finds the temperatures at which the bearing stays.
    void settle() { detail::check(cagedyn_heat_settle(get())); }
    // What the watch ends goes on from the last whole burst with another call.
    void settle(const Watch &watch) { detail::check(cagedyn_heat_settle_with_watch(get(), watch.get())); }
    // Warms up for this time, s.
    void step(double duration) { detail::check(cagedyn_heat_step(get(), duration)); }
    void step(double duration, const Watch &watch)
    {
        detail::check(cagedyn_heat_step_with_watch(get(), duration, watch.get()));
    }

    // Names live as long as the balance.
    std::vector<std::string_view> lumps() const
    {
        return names(cagedyn_heat_lump_count(get()), cagedyn_heat_lump_name);
    }
    // K, one per lump.
    std::vector<double> temperatures() const
    {
        return filled(cagedyn_heat_lump_count(get()), cagedyn_heat_temperatures);
    }
    void set_temperatures(Input temperatures)
    {
        detail::check(cagedyn_heat_set_temperatures(get(), temperatures.data(), temperatures.size()));
    }
    // Heat into each lump, W.
    std::vector<double> into_lumps() const
    {
        return filled(cagedyn_heat_lump_count(get()), cagedyn_heat_into_lumps);
    }
    std::vector<Link> links() const
    {
        std::vector<Link> links;
        for (std::int64_t i = 0, n = detail::counted(cagedyn_heat_link_count(get())); i < n; i++) {
            std::int64_t ends[2] = {};
            detail::check(cagedyn_heat_link(get(), i, ends, 2));
            links.push_back({ends[0], ends[1]});
        }
        return links;
    }
    // Heat through each link, from its first lump to its second, W.
    std::vector<double> flows() const { return filled(cagedyn_heat_link_count(get()), cagedyn_heat_flows); }
    // Names of the powers of the motion that warm lumps.
    std::vector<std::string_view> sources() const
    {
        return names(cagedyn_heat_source_count(get()), cagedyn_heat_source_name);
    }
    // Their heat, W.
    std::vector<double> source_heat() const
    {
        return filled(cagedyn_heat_source_count(get()), cagedyn_heat_sources);
    }
    Quantities quantities() const
    {
        double x[detail::room] = {};
        detail::check(cagedyn_heat_quantities(get(), x, cagedyn_heat_quantity_count()));
        return {x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]};
    }

private:
    using Write = std::int32_t (*)(const cagedyn_heat *, double *, std::int64_t);
    using Name = const char *(*)(const cagedyn_heat *, std::int64_t);

    std::vector<double> filled(std::int64_t count, Write write) const
    {
        std::vector<double> out = detail::zeros(detail::counted(count));
        detail::check(write(get(), out.data(), static_cast<std::int64_t>(out.size())));
        return out;
    }
    std::vector<std::string_view> names(std::int64_t count, Name name) const
    {
        std::vector<std::string_view> names;
        for (std::int64_t i = 0, n = detail::counted(count); i < n; i++) names.push_back(name(get(), i));
        return names;
    }

    std::unique_ptr<cagedyn_heat, detail::Deleter<cagedyn_heat_free>> handle_;
};

// What balls follow at speed: control of a race, axes parallel to that of the bearing, or their friction.
enum class RaceControl : std::int32_t { outer, inner, none, friction };

// The equilibrium of a bearing at the start of its scene, found without time stepping.
class Equilibrium {
public:
    explicit Equilibrium(const Model &model, RaceControl control = RaceControl::outer)
        : handle_(detail::made(cagedyn_equilibrium_find(model.get(), name(control))))
    {
    }

    explicit operator bool() const noexcept { return handle_ != nullptr; }
    const cagedyn_equilibrium *get() const noexcept { return handle_.get(); }

    // Coordinates of the inner ring: those of a bearing with balls are x, y, z, tilt_y and tilt_z, with rollers y and z.
    std::vector<std::string_view> coordinates() const
    {
        return listed(cagedyn_equilibrium_coordinate_count, cagedyn_equilibrium_coordinate_name);
    }
    std::vector<std::string_view> coordinate_units() const
    {
        return listed(cagedyn_equilibrium_coordinate_count, cagedyn_equilibrium_coordinate_unit);
    }
    // Over these, m and rad; N and N m; their derivative row by row.
    std::vector<double> displacement() const { return read(dimension(), cagedyn_equilibrium_displacement); }
    std::vector<double> load() const { return read(dimension(), cagedyn_equilibrium_load); }
    std::vector<double> stiffness() const { return read(dimension() * dimension(), cagedyn_equilibrium_stiffness); }

    std::int64_t elements() const { return detail::counted(cagedyn_equilibrium_element_count(get())); }
    std::vector<std::string_view> contacts() const
    {
        return listed(cagedyn_equilibrium_contact_count, cagedyn_equilibrium_contact_name);
    }
    std::vector<std::string_view> element_quantities() const
    {
        return listed(cagedyn_equilibrium_element_quantity_count, cagedyn_equilibrium_element_quantity_name);
    }
    std::vector<std::string_view> element_units() const
    {
        return listed(cagedyn_equilibrium_element_quantity_count, cagedyn_equilibrium_element_quantity_unit);
    }
    std::vector<std::string_view> contact_quantities() const
    {
        return listed(cagedyn_equilibrium_contact_quantity_count, cagedyn_equilibrium_contact_quantity_name);
    }
    std::vector<std::string_view> contact_units() const
    {
        return listed(cagedyn_equilibrium_contact_quantity_count, cagedyn_equilibrium_contact_quantity_unit);
    }
    // In the order of these quantities.
    std::vector<double> element(std::int64_t index) const
    {
        const std::int64_t n = detail::counted(cagedyn_equilibrium_element_quantity_count(get()));
        return read(n, [index](auto *e, double *out, std::int64_t length) {
            return cagedyn_equilibrium_element(e, index, out, length);
        });
    }
    std::vector<double> contact(std::int64_t index) const
    {
        const std::int64_t n = detail::counted(cagedyn_equilibrium_contact_quantity_count(get()));
        return read(n, [index](auto *e, double *out, std::int64_t length) {
            return cagedyn_equilibrium_contact(e, index, out, length);
        });
    }
    // Places along every roller that may tilt, from its middle, m; load per length of a contact there, N/m.
    std::vector<double> line_load_places() const { return read(places(), cagedyn_equilibrium_line_load_places); }
    std::vector<double> line_loads(std::int64_t contact) const
    {
        return read(places(), [contact](auto *e, double *out, std::int64_t length) {
            return cagedyn_equilibrium_line_loads(e, contact, out, length);
        });
    }
    // Reference life of rollers: none of balls, or without load. In the order of these quantities.
    std::vector<std::string_view> life_quantities() const
    {
        return listed(cagedyn_equilibrium_life_quantity_count, cagedyn_equilibrium_life_quantity_name);
    }
    std::vector<std::string_view> life_units() const
    {
        return listed(cagedyn_equilibrium_life_quantity_count, cagedyn_equilibrium_life_quantity_unit);
    }
    std::vector<double> life() const
    {
        return read(detail::counted(cagedyn_equilibrium_life_quantity_count(get())), cagedyn_equilibrium_life);
    }
    // What is amiss without preventing the equilibrium.
    std::vector<std::string_view> warnings() const
    {
        return listed(cagedyn_equilibrium_warning_count, cagedyn_equilibrium_warning);
    }

private:
    static const char *name(RaceControl control) noexcept
    {
        static constexpr const char *names[] = {"outer", "inner", "none", "friction"};
        return names[static_cast<std::size_t>(control)];
    }
    std::int64_t dimension() const { return detail::counted(cagedyn_equilibrium_coordinate_count(get())); }
    std::int64_t places() const { return detail::counted(cagedyn_equilibrium_line_load_count(get())); }
    template <class Count, class Name> std::vector<std::string_view> listed(Count count, Name name) const
    {
        std::vector<std::string_view> names;
        for (std::int64_t i = 0, n = detail::counted(count(get())); i < n; i++) names.push_back(name(get(), i));
        return names;
    }
    template <class Read> std::vector<double> read(std::int64_t length, Read read) const
    {
        std::vector<double> out = detail::zeros(length);
        detail::check(read(get(), out.data(), static_cast<std::int64_t>(out.size())));
        return out;
    }

    std::unique_ptr<cagedyn_equilibrium, detail::Deleter<cagedyn_equilibrium_free>> handle_;
};

// How a cage moves: the classes of cagedyn_motion_name().
enum class MotionKind : std::int32_t { resting, stable, forward_whirl, backward_whirl, irregular };

// Class and statistics of a motion, in rad/s, m and s. What is not known is NaN.
struct Motion {
    MotionKind kind;
    double mean_whirl_speed, p05_whirl_speed, p95_whirl_speed, mean_radius, turns, settling_time, velocity_deviation;
    // Of the time in each class, stretch by stretch.
    double resting_share, stable_share, forward_share, backward_share, irregular_share;
    // Whether a whirl comes and goes.
    bool intermittent;
};

// Records of a cage: times in s, its centre in m relative to that of the guide, angular speed about that centre and rotation speed
// in rad/s. All have one length.
struct MotionRecords {
    Input times, y, z, whirl_speed, cage_speed;
};

// Of a cage with this radial guide clearance, m (0 without a guide), from a time on, s.
inline Motion cage_motion(const MotionRecords &records, double clearance, double from)
{
    const std::int64_t n = records.times.size();
    const bool equal = records.y.size() == n && records.z.size() == n && records.whirl_speed.size() == n &&
                       records.cage_speed.size() == n;
    double x[detail::room] = {};
    // The library takes one length for all; that they differ is refused there.
    detail::check(cagedyn_cage_motion(records.times.data(), records.y.data(), records.z.data(), records.whirl_speed.data(),
                                      records.cage_speed.data(), equal ? n : -1, clearance, from, x,
                                      cagedyn_motion_count()));
    return {static_cast<MotionKind>(static_cast<std::int32_t>(x[0])), x[1], x[2], x[3], x[4], x[5], x[6], x[7],
            x[8], x[9], x[10], x[11], x[12], x[13] > 0.0};
}

// What samples are in each sector of the orbit: cagedyn_over_orbit_name().
struct OverOrbit {
    std::vector<double> mean, p95, peak, positive_share;
};

// Of samples at these angles, rad, over equal sectors of the orbit from y on, counter-clockwise.
inline OverOrbit over_orbit(Input angles, Input values, std::int64_t sectors)
{
    // More sectors than this the library refuses before it looks at the array.
    const std::int64_t width = sectors > 0 && sectors <= 1 << 20 ? sectors : 0;
    std::vector<double> out = detail::zeros(cagedyn_over_orbit_count() * width);
    const std::int64_t samples = angles.size() == values.size() ? angles.size() : -1;
    detail::check(cagedyn_over_orbit(angles.data(), values.data(), samples, sectors, out.data(),
                                     static_cast<std::int64_t>(out.size())));
    auto row = [&](std::int64_t i) {
        return std::vector<double>(out.begin() + i * width, out.begin() + (i + 1) * width);
    };
    return {row(0), row(1), row(2), row(3)};
}

} // namespace cagedyn

#endif // CAGEDYN_ANALYSIS_HPP
