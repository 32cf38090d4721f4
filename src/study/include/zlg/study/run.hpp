#pragma once
// The main experiment: a gyro that switches modes, what each compensation makes of it, and the same gyro in one mode.
//
// All compensations take the records of ONE run of the twin, so they differ by nothing but the method.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/core/records.hpp>
#include <zlg/rig/switch_count.hpp>
#include <zlg/study/switch_table.hpp>
#include <zlg/study/variant.hpp>
#include <zlg/twin/motion.hpp>

namespace zlg::study {

// A health bit that the control has set: when first, and for how long in all.
struct HealthTime {
    std::string name;
    double first_s = 0.0;
    double total_s = 0.0;
};

struct RunResult {
    double tick_s = 0.0;
    std::int64_t ticks = 0;
    std::string fingerprint;              // rig::Fingerprint of the gyro that switches and of the rows of `configured`
    std::vector<VariantResult> variants;  // one_mode first, configured last
    // As configured, with compensation.magnetic = "estimate"; without a name where it was not asked for. Beside the
    // list, whose names and order are those of old files.
    VariantResult magnetic_estimate;
    std::vector<SwitchLine> switches;  // of the configured compensation
    std::vector<MagnifiedTick> magnified;
    // True false drift on ticks 1, 2, ... after the loop is closed, averaged over the switches with their sign, deg/h.
    std::vector<double> relock_false_drift_deg_h;
    rig::SwitchTally tally;  // of what the control tried
    // Health bits of trouble, which no sound gyro at work raises, and ticks outside the switches whose counts could not
    // be trusted.
    std::uint32_t health_raised = 0;
    std::int64_t invalid_ticks = 0;
    // By phase: measured ticks whose end was read as a whole count, and those of them with health_fringe_lost.
    std::int64_t whole_count_ticks = 0, fringe_lost_ticks = 0;
    std::vector<std::string> warnings;  // what a reader of the figures must know of the configuration
    std::vector<HealthTime> health;     // in the order of their first time

    // Null where there is none of this name.
    [[nodiscard]] const VariantResult* variant(std::string_view name) const {
        const auto found = std::ranges::find(variants, name, &VariantResult::name);
        return found == variants.end() ? nullptr : &*found;
    }
};

struct RunTask {
    config::Config config;
    std::optional<twin::Motion> motion{};  // in place of that of the configuration
    std::vector<std::string> warnings{};   // of the configuration, for the result
    int threads = 1;
    // Names of the variants that are computed beside `configured`, one_mode and magnetic_estimate among them; unset:
    // all. A run of `configured` alone costs a fraction. What is computed has the same bits whatever else is.
    std::optional<std::vector<std::string>> variants;
    // Whether the result has what only a page shows: curves and the magnified switch.
    bool has_figures = true;
    // All optional; called in order, from the calling thread.
    std::function<void(const core::HalfRecord&, const core::LightSamples&)> on_record;
    std::function<void(const core::AngleRow&, double true_arcsec)> on_row;  // the rows of `configured`
    std::function<void(std::int64_t half, std::uint32_t bits)> on_health;   // when the health bits change
    std::function<void(double)> on_progress;                                // 0..1
};

// errors  config::ConfigError, logs::IoError, logs::FormatError; what the sinks throw.
[[nodiscard]] RunResult run(const RunTask& task);

}  // namespace zlg::study
