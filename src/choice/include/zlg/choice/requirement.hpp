#pragma once
// What is required of a gyro, and of which gyros: REQUIRE.toml.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/sweep/description.hpp>

namespace zlg::choice {

struct Requirement {
    // The gyro. A key of what is to be chosen that it gives is kept as it is.
    config::Config base;
    double run_s = 0.0;
    // Of the final angle at the end of the run, less the constant drift that both modes share.
    std::optional<double> angle_error_arcsec;
    std::optional<double> drift_arcsec_s;  // of the mean rate over the run, likewise
    double confidence = 0.95;              // share of the gyros that must meet it
    double tick_min_s = 0.0, tick_max_s = 0.0;
    // Ramps of the rate with this slope, 1 s long, at a random phase over each switch, beside [motion].
    double angular_acceleration_arcsec_s2 = 0.0;
    std::optional<double> delay_s;  // from a tick to its final value
    std::int64_t gyros = 1000;      // on which the choice is proved
    std::vector<sweep::Parameter> tolerance;

    // The largest error of the angle at the end that meets both requirements, arcsec.
    [[nodiscard]] double limit_arcsec() const;
};

// sets  `section.key=value`, over the file.
//
// errors  config::ConfigError: file and line, key, value, what is allowed.
[[nodiscard]] Requirement parse_requirement(std::string_view text, std::string_view source_name,
                                            const std::vector<std::string>& sets = {});
[[nodiscard]] Requirement read_requirement(const std::string& path, const std::vector<std::string>& sets = {});

}  // namespace zlg::choice
