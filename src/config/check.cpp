#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <zlg/config/schema.hpp>
#include <zlg/core/common/discriminator_curve.hpp>
#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/text/toml_text.hpp>

#include "key.hpp"

namespace zlg::config {

namespace {

void check_bridge(const Config& config) {
    const Compensation& c = config.compensation;
    // A polynomial of order m goes through m + 1 points.
    const int order = order_of(c.bridge);
    const auto complain = [&](std::string_view where, std::int64_t points) {
        throw ConfigError(fmt::format("compensation.bridge = {}: a bridge of order {} needs {} points, but {} is {}",
                                      value_text(*find_key("compensation", "bridge"), config), order, order + 1, where,
                                      points));
    };
    if (order > c.extrapolation_points - 1) complain("compensation.extrapolation_points", c.extrapolation_points);
    const std::int64_t both_sides = c.points_before + c.points_after;
    if (order > both_sides - 1) complain("compensation.points_before + points_after", both_sides);
}

void check_motion(const Motion& m) {
    if (m.kind == MotionKind::file && m.path.empty()) {
        throw ConfigError("motion.path = \"\": motion.kind = \"file\" needs the path of a motion file");
    }
    if (m.kind != MotionKind::sine && m.kind != MotionKind::sum) return;
    const std::size_t n = m.amplitude_arcsec_s.size();
    // One phase serves all sines.
    const bool phases_fit = m.phase_deg.size() == n || m.phase_deg.size() == 1;
    if (m.frequency_hz.size() != n || !phases_fit) {
        throw ConfigError(fmt::format(
            "motion.amplitude_arcsec_s: {} numbers, motion.frequency_hz: {}, motion.phase_deg: {}; allowed is "
            "an equal number of each, or one phase for all",
            n, m.frequency_hz.size(), m.phase_deg.size()));
    }
    if (m.kind == MotionKind::sine && n != 1) {
        throw ConfigError(
            fmt::format("motion.amplitude_arcsec_s: {} numbers; motion.kind = \"sine\" has one, use \"sum\"", n));
    }
}

void require_growth(std::string_view name, const std::vector<double>& values) {
    const auto fallen = std::adjacent_find(values.begin(), values.end(), std::greater_equal{});
    if (fallen == values.end()) return;
    throw ConfigError(fmt::format("perimeter.{}: {} after {}; allowed is growth", name, text::toml_real(fallen[1]),
                                  text::toml_real(*fallen)));
}

// A curve through the origin, of the side above it or of both: as many of each, growing, of the same sign.
void check_discriminator(const Perimeter& p) {
    constexpr auto most = static_cast<std::ptrdiff_t>(core::max_side_nodes);
    const std::vector<double>& detuning = p.discriminator_detuning_lambda;
    const std::vector<double>& signal = p.discriminator_signal;
    const auto n_below = std::count_if(detuning.begin(), detuning.end(), [](double x) { return x < 0.0; });
    const auto n_above = std::ssize(detuning) - n_below;
    if (signal.size() != detuning.size() || n_below > most || n_above > most) {
        throw ConfigError(fmt::format(
            "perimeter.discriminator_detuning_lambda: {} numbers, perimeter.discriminator_signal: {}; allowed are as "
            "many of each, {} at most on a side of 0",
            detuning.size(), signal.size(), most));
    }
    require_growth("discriminator_detuning_lambda", detuning);
    require_growth("discriminator_signal", signal);
    for (std::size_t k = 0; k < detuning.size(); ++k) {
        if (detuning[k] * signal[k] > 0.0) continue;
        throw ConfigError(
            fmt::format("perimeter: discriminator_signal is {} at discriminator_detuning_lambda {}; allowed is the "
                        "same sign, and not 0",
                        text::toml_real(signal[k]), text::toml_real(detuning[k])));
    }
    if (n_below > 0 && n_above == 0)
        throw ConfigError(
            fmt::format("perimeter.discriminator_detuning_lambda: {} points below 0 and none above; allowed are those "
                        "above 0, or both",
                        n_below));
}

void check_dither(const Config& config) {
    const Gyro& gyro = config.gyro;
    if (gyro.dither == core::DitherMethod::none || gyro.fidelity == Fidelity::laser) return;
    throw ConfigError(fmt::format(
        "gyro.dither = {}: the averaged gyro reverses its bias evenly; allowed is gyro.fidelity = \"laser\"",
        value_text(*find_key("gyro", "dither"), config)));
}

// What is wrong with points, empty where nothing is.
std::string fault_of(const std::vector<twin::CoursePoint>& points, std::size_t least, const char* places) {
    constexpr double most = 1e6, longest_s = 1e9;
    if (points.size() < least) return fmt::format("{} points; allowed are {} or more", points.size(), least);
    for (std::size_t k = 0; k < points.size(); ++k) {
        const twin::CoursePoint& point = points[k];
        if (!(std::abs(point.at_s) <= longest_s) || !(std::abs(point.value) <= most))
            return fmt::format("point {} is [{}, {}]; allowed are numbers, {} up to {:g}, values up to {:g}", k + 1,
                               point.at_s, point.value, places, longest_s, most);
        if (k > 0 && !(point.at_s > points[k - 1].at_s))
            return fmt::format("point {} is at {}, the one before at {}; allowed are rising {}", k + 1, point.at_s,
                               points[k - 1].at_s, places);
    }
    return {};
}

// Of a file that is not read yet only the name is known.
void check_course(const char* key, const Course& course, std::size_t least, const char* places = "times in s") {
    if (course.points.empty() && !course.path.empty()) return;
    const std::string fault = fault_of(course.points, least, places);
    if (fault.empty()) return;
    throw ConfigError(fmt::format("{}{}{}: {}", key, course.path.empty() ? "" : " = ", course.path, fault));
}

void check_faults(const Faults& f) {
    const std::size_t n = f.kind.size();
    if (f.at_s.size() == n && f.duration_s.size() == n && f.size.size() == n) return;
    throw ConfigError(
        fmt::format("faults.kind: {}, faults.at_s: {}, faults.duration_s: {}, faults.size: {}; allowed is as "
                    "many of each",
                    n, f.at_s.size(), f.duration_s.size(), f.size.size()));
}

void check_times(const Gyro& gyro, const Switching& switching) {
    if (!(gyro.bias_edge_s < gyro.tick_s / 2.0)) {
        throw ConfigError(fmt::format("gyro.bias_edge_s = {}: allowed is below half of gyro.tick_s = {}",
                                      text::toml_real(gyro.bias_edge_s), text::toml_real(gyro.tick_s)));
    }
    if (switching.gap_min_ticks > switching.gap_ticks) {
        throw ConfigError(fmt::format("switching.gap_min_ticks = {}: allowed is up to switching.gap_ticks = {}",
                                      switching.gap_min_ticks, switching.gap_ticks));
    }
    const auto min_ticks = static_cast<double>(switching.gap_ticks + 2);
    if (!switching.interval_optimal && !(switching.interval_s >= min_ticks * gyro.tick_s)) {
        throw ConfigError(fmt::format(
            "switching.interval_s = {}: allowed is from switching.gap_ticks + 2 = {} ticks of gyro.tick_s = {} s: {} s",
            text::toml_real(switching.interval_s), min_ticks, text::toml_real(gyro.tick_s),
            text::toml_real(min_ticks * gyro.tick_s)));
    }
}

void check_interval_limits(const Gyro& gyro, const Switching& s) {
    const double min_s = static_cast<double>(s.gap_ticks + 2) * gyro.tick_s;
    if (s.schedule != Schedule::fixed && !(s.interval_min_s >= min_s)) {
        throw ConfigError(fmt::format(
            "switching.interval_min_s = {}: allowed is from switching.gap_ticks + 2 ticks of gyro.tick_s = {} s, "
            "{} s, where switching.schedule is not fixed",
            text::toml_real(s.interval_min_s), text::toml_real(gyro.tick_s), text::toml_real(min_s)));
    }
    if (!(s.interval_min_s <= s.interval_max_s)) {
        throw ConfigError(fmt::format("switching.interval_min_s = {}: allowed is up to switching.interval_max_s = {}",
                                      text::toml_real(s.interval_min_s), text::toml_real(s.interval_max_s)));
    }
}

}  // namespace

void check_environment(const Config& config) {
    const Course& table = config.gyro.bias_temperature_table;
    if (table.is_given()) check_course("gyro.bias_temperature_table", table, 2, "temperatures in C");
    if (config.temperature.profile.is_given()) check_course("temperature.profile", config.temperature.profile, 2);
    const Field& field = config.field;
    const auto wrong = [&](const char* allowed) {
        throw ConfigError(fmt::format("field.course: field.kind = {} needs {}",
                                      value_text(*find_key("field", "kind"), config), allowed));
    };
    const bool is_listed = field.course.is_given() && field.course.path.empty();
    if (field.kind == FieldKind::steps && !is_listed) wrong("[[time, field], ...]");
    if (field.kind == FieldKind::file && field.course.path.empty()) wrong("the path of a file");
    if (field.kind == FieldKind::steps) check_course("field.course", field.course, 1);
    if (field.kind == FieldKind::file) check_course("field.course", field.course, 2);
}

void check_compensation(const Config& config) {
    for (const Key& key : all_keys()) {
        if (key.section == "compensation" || key.section == "gyro") check_range(key, config);
    }
    check_bridge(config);
}

void check(const Config& config) {
    for (const Key& key : all_keys()) check_range(key, config);
    check_bridge(config);
    check_times(config.gyro, config.switching);
    check_interval_limits(config.gyro, config.switching);
    check_discriminator(config.perimeter);
    if (const std::size_t n = config.gyro.bias_chi_higher.size(); n > core::LossBend{}.term.size())
        throw ConfigError(fmt::format("gyro.bias_chi_higher: {} numbers; allowed is up to 3", n));
    check_dither(config);
    check_motion(config.motion);
    check_environment(config);
    check_faults(config.faults);
    if (!(config.piezo.range_min_v < config.piezo.range_max_v)) {
        throw ConfigError(fmt::format("piezo.range_min_v = {}: allowed is below piezo.range_max_v = {}",
                                      text::toml_real(config.piezo.range_min_v),
                                      text::toml_real(config.piezo.range_max_v)));
    }
}

}  // namespace zlg::config
