#pragma once
// What the gyro lives in, as sections of a configuration: the temperature of its block, and a magnetic field.

#include <string>
#include <vector>

namespace zlg::twin {

struct CoursePoint {
    double at_s = 0.0;
    double value = 0.0;
};

// Points in rising times, or the file that holds them. It is read by whoever may read files, into `points`.
struct CourseConfig {
    std::vector<CoursePoint> points;
    std::string path;

    [[nodiscard]] bool is_file() const { return !path.empty(); }
    [[nodiscard]] bool is_given() const { return is_file() || !points.empty(); }
};

// [temperature]
struct TemperatureConfig {
    CourseConfig profile;       // C, straight between its points, even before and after them; none: [gyro] warms it
    double sensor_lag_s = 0.0;  // time constant of the sensor behind the block
    double sensor_error_c = 0.0;
};

// none: [drift] tells the magnetic drift.
enum class FieldKind { none, constant, sine, steps, file };

// [field]: the magnetic drift is sensitivity_arcsec_s_g (1 + sensitivity_per_c (T - gyro.reference_temperature_c))
// field.
struct FieldConfig {
    FieldKind kind = FieldKind::none;
    double field_g = 0.5;  // of `constant`; the amplitude of `sine`
    double frequency_hz = 0.01;
    CourseConfig course;                  // of `steps`, each from its time on; of `file`, straight between its rows
    double sensitivity_arcsec_s_g = 1.4;  // at the reference temperature
    double sensitivity_per_c = 0.0;
};

}  // namespace zlg::twin
