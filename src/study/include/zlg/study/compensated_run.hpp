#pragma once
// A run of the configured gyro with its configured compensation, of which only the errors are kept.

#include <cstdint>

#include <zlg/config/config.hpp>
#include <zlg/study/variant.hpp>

namespace zlg::study {

// stride  ticks between two points of the curve of the error.
//
// errors  config::ConfigError; those of a motion file.
[[nodiscard]] ErrorMeter compensated_run(const config::Config& config, std::int64_t ticks, std::int64_t stride);

}  // namespace zlg::study
