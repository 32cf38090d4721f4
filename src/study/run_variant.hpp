#pragma once
// The compensations that a run compares, each with the meter of its error.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/study/variant.hpp>

namespace zlg::study {

// One compensation of the records, with its error meter.
struct Variant {
    const char* name;
    const char* meaning;
    rig::Replay replay;
    ErrorMeter meter;
    std::array<double, core::history_ticks> taken_out_arcsec{};  // of the magnetic drift, by tick

    [[nodiscard]] VariantResult result() const {
        return {name,
                meaning,
                meter.drift_arcsec_s(),
                meter.angle_error_arcsec(),
                statistics(meter.switches()),
                std::ranges::count(meter.switches(), true, &SwitchError::unrepaired),
                meter.switches(),
                meter.curve()};
    }
};

// Those that the paper compares, and last the configured one. stride: as of ErrorMeter.
[[nodiscard]] std::vector<Variant> variants(const config::Config& config, std::int64_t stride);

}  // namespace zlg::study
