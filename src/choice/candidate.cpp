#include <zlg/choice/candidate.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/design/relock_loop.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/report/number_text.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/switch_trial.hpp>

#include "forecast.hpp"

namespace zlg::choice {
namespace {

using core::BridgeMethod;
using core::MagneticMethod;
using core::RelockMethod;

struct Correction {
    RelockMethod relock;
    BridgeMethod bridge;
    int additions = 0;
};

// Linear bridges give the final values of constant ones, for the points lie symmetrically.
constexpr std::array corrections{Correction{RelockMethod::none, BridgeMethod::constant},
                                 Correction{RelockMethod::none, BridgeMethod::quadratic},
                                 Correction{RelockMethod::frequency, BridgeMethod::constant},
                                 Correction{RelockMethod::frequency, BridgeMethod::quadratic},
                                 Correction{RelockMethod::detuning, BridgeMethod::constant},
                                 Correction{RelockMethod::detuning, BridgeMethod::quadratic},
                                 Correction{RelockMethod::mean_square, BridgeMethod::constant},
                                 Correction{RelockMethod::mean_square, BridgeMethod::quadratic},
                                 Correction{RelockMethod::joint, BridgeMethod::automatic, 1}};

bool is_open(const Requirement& r, std::string_view key) { return !config::is_given(r.base, key); }

// As configured where a key of it is given, else all of them.
std::vector<Correction> open_corrections(const Requirement& r) {
    const bool relock_open = is_open(r, "compensation.relock");
    const bool bridge_open = is_open(r, "compensation.bridge");
    const config::Compensation& c = r.base.compensation;
    std::vector<Correction> open;
    for (const Correction& one : corrections)
        if ((relock_open || one.relock == c.relock) && (bridge_open || one.bridge == c.bridge)) open.push_back(one);
    if (open.empty()) open.push_back({c.relock.value_or(RelockMethod::mean_square), c.bridge});
    return open;
}

std::vector<Reading> open_readings(const Requirement& r) {
    const bool is_x4 = r.base.laser.quadrature == twin::Quadrature::x4;
    std::vector<Reading> open;
    if (is_open(r, "gyro.readout") || r.base.gyro.readout == config::Readout::counts) {
        if (!is_x4) open.push_back(Reading::x1);
        if (is_x4 || is_open(r, "laser.quadrature")) open.push_back(Reading::x4);
    }
    if (is_open(r, "gyro.readout") || r.base.gyro.readout == config::Readout::phase) open.push_back(Reading::phase);
    return open;
}

// The gyro's own where the range holds it, else the end next to it; then the ends.
std::vector<double> ticks_s(const Requirement& r) {
    const double own = std::clamp(r.base.gyro.tick_s, r.tick_min_s, r.tick_max_s);
    std::vector<double> ticks{own};
    for (const double tick : {r.tick_max_s, r.tick_min_s})
        if (std::ranges::find(ticks, tick) == ticks.end()) ticks.push_back(tick);
    return ticks;
}

// Why the loop and the switch leave no room for such a tick; empty where they do.
std::string why_not_tick(const Requirement& r, double tick_s) {
    const config::Config gyro = with(r.base, {.method = {.tick_s = tick_s}, .interval_s = r.run_s});
    try {
        config::check(gyro);
        (void)rig::control_config(gyro);
    } catch (const config::ConfigError& error) {
        return error.what();
    }
    if (const double held_s = recorded::motion(gyro).duration_s(); held_s < least_trial_s(gyro))
        return fmt::format("the motion file lasts {:.6g} s; to learn the error of a switch takes {:.6g} s or more",
                           held_s, least_trial_s(gyro));
    if (gyro.perimeter.miss_lambda == 0.0 || gyro.compensation.relock_ticks == 0) return "";
    const design::RelockLoop loop{.tick_s = tick_s,
                                  .tau_s = gyro.perimeter.tau_s,
                                  .limit_lambda = gyro.perimeter.limit_lambda,
                                  .rc_s = gyro.piezo.rc_s,
                                  .slew_lambda_s = 0.5 * gyro.piezo.slew_v_s / gyro.piezo.half_wave_v};
    constexpr double settled_lambda = 0.01;
    const int corrected = gyro.compensation.relock_ticks;
    if (std::isfinite(design::relock_time_s(loop, gyro.perimeter.miss_lambda, settled_lambda, corrected))) return "";
    return fmt::format("the loop does not come within {} wavelength in the corrected ticks, {:.3g} ms", settled_lambda,
                       1e3 * tick_s * corrected);
}

std::vector<config::Schedule> open_schedules(const Requirement& r) {
    if (!is_open(r, "switching.schedule") || !is_open(r, "switching.interval_s")) return {r.base.switching.schedule};
    return {config::Schedule::fixed, config::Schedule::measured};
}

std::vector<MagneticMethod> open_magnetics(const Requirement& r) {
    if (!is_open(r, "compensation.magnetic")) return {r.base.compensation.magnetic};
    return {MagneticMethod::none, MagneticMethod::estimate};
}

// Of this tick, in the order of the last additions.
void add_methods(const Requirement& r, double tick_s, int tick_additions, std::vector<Method>& all) {
    for (const MagneticMethod magnetic : open_magnetics(r))
        for (const config::Schedule schedule : open_schedules(r))
            for (const Reading reading : open_readings(r))
                for (const Correction& c : open_corrections(r))
                    all.push_back({.relock = c.relock,
                                   .bridge = c.bridge,
                                   .reading = reading,
                                   .schedule = schedule,
                                   .magnetic = magnetic,
                                   .tick_s = tick_s,
                                   .additions = tick_additions + c.additions + static_cast<int>(reading) +
                                                (schedule == config::Schedule::measured ? 1 : 0) +
                                                (magnetic == MagneticMethod::estimate ? 1 : 0)});
}

std::string_view name_of(Reading reading) {
    constexpr std::array<std::string_view, 3> names{"counts x1", "counts x4", "phase"};
    return names.at(static_cast<std::size_t>(reading));
}

}  // namespace

Methods methods(const Requirement& requirement) {
    Methods found;
    int tick_additions = 0;
    for (const double tick_s : ticks_s(requirement)) {
        if (const std::string why = why_not_tick(requirement, tick_s); !why.empty())
            found.excluded.push_back(fmt::format("A tick of {:.4g} ms is excluded: {}.", 1e3 * tick_s, why));
        else
            add_methods(requirement, tick_s, tick_additions, found.all);
        tick_additions = 1;
    }
    std::erase_if(found.all, [&](const Method& m) {
        const config::Config gyro = with(requirement.base, {.method = m, .interval_s = requirement.run_s});
        return requirement.delay_s && final_delay_s(gyro) > *requirement.delay_s;
    });
    std::ranges::stable_sort(found.all, {}, &Method::additions);
    return found;
}

std::vector<Candidate> candidates(const Requirement& requirement, const Method& method) {
    const config::Config gyro = with(requirement.base, {.method = method, .interval_s = requirement.run_s});
    const double least_s =
        std::max(2.0 * study::shortest_interval_s(gyro), requirement.angular_acceleration_arcsec_s2 > 0.0 ? 2.0 : 0.0);
    std::set<double, std::greater<>> intervals_s;
    if (!is_open(requirement, "switching.interval_s") && !requirement.base.switching.interval_optimal) {
        intervals_s.insert(requirement.base.switching.interval_s);
    } else {
        for (int parts = 1; parts <= 12; ++parts) intervals_s.insert(requirement.run_s / parts);
        for (double parts = 14.0; requirement.run_s / parts >= least_s; parts *= 1.25)
            intervals_s.insert(requirement.run_s / std::round(parts));
        for (double decade = 1.0; decade < requirement.run_s; decade *= 10.0)
            for (const double step : {1.0, 1.5, 2.0, 3.0, 4.5, 6.0, 9.0}) intervals_s.insert(decade * step);
        std::erase_if(intervals_s, [&](double s) { return !(s >= least_s && s < requirement.run_s); });
        intervals_s.insert(requirement.run_s);
    }
    std::vector<config::FirstSegment> firsts{config::FirstSegment::full, config::FirstSegment::half};
    if (!is_open(requirement, "switching.first_segment")) firsts = {requirement.base.switching.first_segment};
    std::vector<Candidate> all;
    for (const double interval_s : intervals_s)
        for (const config::FirstSegment first : firsts) all.push_back({method, interval_s, first});
    return all;
}

void keep_with_tick(config::Config& gyro, double factor) {
    gyro.switching.gap_ticks = std::clamp(static_cast<int>(std::ceil(gyro.switching.gap_ticks / factor - 1e-9)), 1, 40);
    gyro.drift.random_walk_arcsec_sqrt_s /= std::sqrt(factor);
}

config::Config with(config::Config gyro, const Candidate& c) {
    const Method& m = c.method;
    if (m.tick_s != gyro.gyro.tick_s) {
        keep_with_tick(gyro, m.tick_s / gyro.gyro.tick_s);
        gyro.gyro.tick_s = m.tick_s;
    }
    if (m.reading == Reading::x4 && gyro.laser.quadrature != twin::Quadrature::x4) {
        gyro.laser.quadrature = twin::Quadrature::x4;
        gyro.gyro.scale_arcsec /= 4.0;
        gyro.gyro.bias_hz *= 4.0;
        if (gyro.gyro.counter_max_hz) *gyro.gyro.counter_max_hz *= 4.0;
    }
    gyro.gyro.readout = m.reading == Reading::phase ? config::Readout::phase : config::Readout::counts;
    gyro.compensation.relock = m.relock;
    gyro.compensation.bridge = m.bridge;
    gyro.compensation.magnetic = m.magnetic;
    gyro.switching.schedule = m.schedule;
    gyro.switching.interval_s = c.interval_s;
    gyro.switching.interval_optimal = false;
    gyro.switching.first_segment = c.first_segment;
    if (m.schedule == config::Schedule::measured) {
        gyro.switching.interval_max_s = c.interval_s;
        gyro.switching.interval_min_s = std::min(gyro.switching.interval_min_s, c.interval_s);
    }
    return gyro;
}

std::vector<std::pair<std::string, std::string>> chosen_keys(const config::Config& gyro, const Candidate& c) {
    constexpr std::array decided{"switching.",         "compensation.",  "gyro.tick_s",      "gyro.readout",
                                 "gyro.scale_arcsec",  "gyro.bias_hz",   "laser.quadrature", "perimeter.loop",
                                 "drift.random_walk_", "perimeter.tau_", "perimeter.limit_"};
    std::vector<std::pair<std::string, std::string>> keys = config::to_settings(with(gyro, c));
    std::erase_if(keys, [&](const auto& key) {
        return std::ranges::none_of(decided, [&](const char* begin) { return key.first.starts_with(begin); });
    });
    return keys;
}

std::string in_words(const Candidate& c) {
    const Method& m = c.method;
    const auto name = [&](const char* key) {
        for (const auto& [found, value] : chosen_keys({}, c))
            if (found == key) return value.substr(1, value.size() - 2);
        return std::string{};
    };
    return fmt::format("{} s ({}{}), {}, relock {}, bridge {}{}, tick {:.4g} ms", report::short_number(c.interval_s),
                       m.schedule == config::Schedule::fixed ? "fixed" : "measured",
                       c.first_segment == config::FirstSegment::half ? ", half first segment" : "", name_of(m.reading),
                       name("compensation.relock"), name("compensation.bridge"),
                       m.magnetic == MagneticMethod::estimate ? ", magnetic estimate" : "", 1e3 * m.tick_s);
}

double final_delay_s(const config::Config& gyro) {
    try {
        const config::Compensation& c = gyro.compensation;
        const core::GyroCompensationConfig made = rig::compensation_config(gyro, *c.relock, c.bridge);
        return final_delay_ticks(made.gyro, bridge_of(made)) * gyro.gyro.tick_s;
    } catch (const config::ConfigError&) {
        return std::numeric_limits<double>::infinity();
    }
}

}  // namespace zlg::choice
