#pragma once
// The main experiment: a gyro that switches modes, what each compensation makes of it, and the same gyro in one mode.
//
// All compensations take the records of ONE run of the twin, so they differ by nothing but the method.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/core/records.hpp>
#include <zlg/rig/processor.hpp>
#include <zlg/rig/switch_count.hpp>
#include <zlg/study/switch_window.hpp>
#include <zlg/study/variant.hpp>

namespace zlg::study {

struct VariantResult {
    std::string name;
    double drift_arcsec_s = 0.0;      // least-squares slope of the angle error over the run
    double angle_error_arcsec = 0.0;  // at the end
    std::optional<SwitchStatistics> switch_error;
    std::vector<SwitchError> switches;
    Curve curve;
};

// One line of the table of switches.
struct SwitchLine {
    std::int64_t tick = 0;     // first of the gap
    int mode = 1;              // after the switch
    double miss_lambda = 0.0;  // mean detuning of the first half with the loop closed; NaN where unknown
    double half_wave_v = 0.0;  // estimate after this switch, and its standard deviation
    double half_wave_sigma_v = 0.0;
    std::int64_t gap_ticks = 0;
    double dp_arcsec = 0.0;          // eq (16)
    double relock_arcsec = 0.0;      // false angle subtracted
    double sigma_arcsec = 0.0;       // of the gap's final angle
    double true_error_arcsec = 0.0;  // NaN where the run ended before the re-lock did
};

struct RunResult {
    double tick_s = 0.0;
    std::int64_t ticks = 0;
    std::vector<VariantResult> variants;  // one_mode first, configured last
    std::vector<SwitchLine> switches;     // of the configured compensation
    std::vector<MagnifiedTick> magnified;
    // True false drift on ticks 1, 2, ... after the loop is closed, averaged over the switches with their sign, deg/h.
    std::vector<double> relock_false_drift_deg_h;
    rig::SwitchTally tally;             // of what the control tried
    std::vector<std::string> warnings;  // what a reader of the figures must know of the configuration
};

struct RunTask {
    config::Config config;
    std::vector<std::string> warnings;  // of the configuration, for the result
    int threads = 1;
    // Runs the core of the gyro that switches, and its configured compensation; null: this program does. The gyro of
    // one mode and the other compensations always run here.
    rig::Processor* processor = nullptr;
    // All optional; called in order, from the calling thread.
    std::function<void(const core::HalfRecord&, const core::LightSamples&)> on_record;
    std::function<void(const core::AngleRow&, double true_arcsec)> on_row;  // the rows of `configured`
    std::function<void(std::int64_t half, std::uint32_t bits)> on_health;   // when the health bits change
    std::function<void(double)> on_progress;                                // 0..1
};

// errors  config::ConfigError, logs::IoError, logs::FormatError; what the sinks throw.
[[nodiscard]] RunResult run(const RunTask& task);

}  // namespace zlg::study
