#include <zlg/twin/environment.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <zlg/core/common/maths.hpp>

namespace zlg::twin {
namespace {

// The first point after that time.
std::span<const CoursePoint>::iterator after(std::span<const CoursePoint> points, double time_s) {
    return std::upper_bound(points.begin(), points.end(), time_s,
                            [](double time, const CoursePoint& point) { return time < point.at_s; });
}

}  // namespace

double between(std::span<const CoursePoint> points, double time_s) {
    const auto next = after(points, time_s);
    if (next == points.begin()) return points.front().value;
    if (next == points.end()) return points.back().value;
    const CoursePoint& from = *(next - 1);
    return from.value + (time_s - from.at_s) / (next->at_s - from.at_s) * (next->value - from.value);
}

double stepped(std::span<const CoursePoint> points, double time_s) {
    const auto next = after(points, time_s);
    return next == points.begin() ? points.front().value : (next - 1)->value;
}

TemperatureSpan temperature_span(const GyroConfig& gyro, const TemperatureConfig& temperature) {
    if (temperature.profile.points.empty())
        return {std::min(0.0, gyro.temperature_rise_c), std::max(0.0, gyro.temperature_rise_c)};
    const auto [least, most] =
        std::minmax_element(temperature.profile.points.begin(), temperature.profile.points.end(),
                            [](const CoursePoint& a, const CoursePoint& b) { return a.value < b.value; });
    return {least->value - gyro.reference_temperature_c, most->value - gyro.reference_temperature_c};
}

double bias_change(const GyroConfig& gyro, double above_reference_c) {
    const std::span<const CoursePoint> table = gyro.bias_temperature_table.points;
    return table.empty() ? gyro.bias_temperature_coefficient_per_c * above_reference_c
                         : between(table, gyro.reference_temperature_c + above_reference_c);
}

double field_g(const FieldConfig& field, double time_s) {
    switch (field.kind) {
        case FieldKind::none: break;
        case FieldKind::constant: return field.field_g;
        case FieldKind::sine: {
            const double turns = field.frequency_hz * time_s;
            return field.field_g * core::maths::sin(2.0 * std::numbers::pi * (turns - std::floor(turns)));
        }
        case FieldKind::steps: return stepped(field.course.points, time_s);
        case FieldKind::file: return between(field.course.points, time_s);
    }
    return 0.0;
}

double field_stays_until_s(const FieldConfig& field, double time_s) {
    if (field.kind == FieldKind::sine || field.kind == FieldKind::file) return time_s;
    if (field.kind != FieldKind::steps) return std::numeric_limits<double>::infinity();
    const std::span<const CoursePoint> points = field.course.points;
    const auto next = after(points, time_s);
    return next == points.end() ? std::numeric_limits<double>::infinity() : next->at_s;
}

}  // namespace zlg::twin
