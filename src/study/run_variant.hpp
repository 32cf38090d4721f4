#pragma once
// The compensations that a run compares, each with the meter of its error.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/study/variant.hpp>

namespace zlg::study {

inline constexpr const char* magnetic_estimate = "magnetic_estimate";
// One compensation, that the paper compares twice: with other corrections of the re-lock, and with other bridges.
inline constexpr const char* relock_detuning = "relock_detuning";
inline constexpr const char* bridge_quadratic = "bridge_quadratic";

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
                meter.drift_without_nonmagnetic_arcsec_s(),
                meter.angle_error_arcsec(),
                meter.angle_error_without_nonmagnetic_arcsec(),
                statistics(meter.switches()),
                std::ranges::count(meter.switches(), true, &SwitchError::unrepaired),
                meter.switches(),
                meter.curve()};
    }
};

// Whether a variant is among those that a task asks for: see RunTask::variants.
[[nodiscard]] inline bool is_wanted(const std::optional<std::vector<std::string>>& wanted, std::string_view name) {
    return !wanted || std::ranges::find(*wanted, name) != wanted->end();
}

// Of the wanted ones those that the paper compares, magnetic_estimate unless the configuration is that, and last the
// configured one in any case; bridge_quadratic only without relock_detuning. stride: as of ErrorMeter.
[[nodiscard]] std::vector<Variant> variants(const config::Config& config, std::int64_t stride,
                                            const std::optional<std::vector<std::string>>& wanted);

}  // namespace zlg::study
