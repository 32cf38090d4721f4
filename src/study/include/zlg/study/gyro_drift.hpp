#pragma once
// The drift of a configuration.

#include <zlg/config/config.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/design/magnetic_angle.hpp>
#include <zlg/twin/environment.hpp>

namespace zlg::study {

// As the closed forms of design, optimal interval and choice have it: warmed alone, without a field.
//
// errors  config::ConfigError where [field] or temperature.profile make another drift of it.
[[nodiscard]] design::GyroDrift gyro_drift(const config::Config& config);

// Of a run, in its environment: how far the drift that changes its sign turns the gyro in the left mode.
class RunDrift {
public:
    RunDrift(const design::GyroDrift& law) : law_{law} {}  // of no profile and no field
    explicit RunDrift(const config::Config& config)
        : law_{law_of(config.drift)}, gyro_{config.gyro}, temperature_{config.temperature}, field_{config.field} {}

    // The change by warming, whatever else there is.
    [[nodiscard]] static design::GyroDrift law_of(const config::Drift& d) {
        return {.nonmagnetic_arcsec_s = d.nonmagnetic_arcsec_s,
                .magnetic_arcsec_s = d.magnetic_arcsec_s,
                .magnetic_thermal_arcsec_s = d.magnetic_thermal_arcsec_s,
                .thermal_time_s = d.thermal_time_s};
    }

    [[nodiscard]] double nonmagnetic_arcsec_s() const { return law_.nonmagnetic_arcsec_s; }

    // In a tick, as the twin makes it of the middle of a time, where profile or field is given.
    [[nodiscard]] double magnetic_arcsec(double start_s, double end_s) const {
        const bool has_profile = !temperature_.profile.points.empty();
        if (!has_profile && field_.kind == twin::FieldKind::none)
            return design::magnetic_integral_arcsec(law_, start_s, end_s);
        const double middle_s = 0.5 * (start_s + end_s);
        const double above_c =
            has_profile ? twin::between(temperature_.profile.points, middle_s) - gyro_.reference_temperature_c
                        : gyro_.temperature_rise_c * -core::maths::expm1(-middle_s / law_.thermal_time_s);
        const double rate_arcsec_s =
            field_.kind != twin::FieldKind::none
                ? twin::magnetic_arcsec_s(field_, above_c, middle_s)
                : law_.magnetic_arcsec_s + law_.magnetic_thermal_arcsec_s * above_c / gyro_.temperature_rise_c;
        return rate_arcsec_s * (end_s - start_s);
    }

private:
    design::GyroDrift law_;
    twin::GyroConfig gyro_;
    twin::TemperatureConfig temperature_;
    twin::FieldConfig field_;
};

}  // namespace zlg::study
