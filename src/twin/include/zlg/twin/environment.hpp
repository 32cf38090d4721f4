#pragma once
// Temperature and magnetic drift at any time of a run, of a gyro in a given environment.

#include <span>

#include <zlg/twin/environment_config.hpp>
#include <zlg/twin/gyro_config.hpp>

namespace zlg::twin {

// Of points in rising times, one or more: the value on the straight line between two, that of the first before them and
// that of the last after them.
[[nodiscard]] double between(std::span<const CoursePoint> points, double time_s);

// That of the last point up to then, or of the first one.
[[nodiscard]] double stepped(std::span<const CoursePoint> points, double time_s);

// How far from its reference the gyro gets.
struct TemperatureSpan {
    double least_c = 0.0;
    double most_c = 0.0;
};
[[nodiscard]] TemperatureSpan temperature_span(const GyroConfig& gyro, const TemperatureConfig& temperature);

// Relative change of the bias of a gyro that is so much warmer than at its reference: by its table, straight between
// the points, or by its coefficient.
[[nodiscard]] double bias_change(const GyroConfig& gyro, double above_reference_c);

// Gauss.
[[nodiscard]] double field_g(const FieldConfig& field, double time_s);

// When the field leaves what it is at a time: of steps the next one, infinite after the last and of a constant one; of
// others that time.
[[nodiscard]] double field_stays_until_s(const FieldConfig& field, double time_s);

// The drift that the field makes in the left mode of a gyro that is so much warmer than at its reference.
[[nodiscard]] inline double magnetic_arcsec_s(const FieldConfig& field, double above_reference_c, double time_s) {
    return field.sensitivity_arcsec_s_g * (1.0 + field.sensitivity_per_c * above_reference_c) * field_g(field, time_s);
}

}  // namespace zlg::twin
