#pragma once
// What a gyro reads at the end of a half, less its true phase.

#include <cmath>

#include <zlg/config/config.hpp>
#include <zlg/core/records.hpp>
#include <zlg/rig/closed_loop.hpp>

namespace zlg::study {

// Readout by counts: error of the counter, which rounds down. By phase: of count and place together, or of the middle
// of the count where the place is not known. Of a laser, whose true phase is not known, 0.
[[nodiscard]] inline double reading_error_arcsec(const config::Config& config, const rig::LoopHalf& half) {
    const double rounding_arcsec = half.truth.rounding_arcsec;
    const bool by_phase = config.gyro.readout == config::Readout::phase;
    if (!by_phase || config.gyro.fidelity == config::Fidelity::laser) return rounding_arcsec;
    const double scale_arcsec = config.gyro.scale_arcsec;
    const double parts = core::has_fringe(half.record) ? half.record.fringe : 0.5 * core::count_parts;
    const double error_arcsec = scale_arcsec * parts / core::count_parts + rounding_arcsec;
    // At a border count and place may lie on different sides: the difference is taken modulo a count.
    return core::has_fringe(half.record) ? std::remainder(error_arcsec, scale_arcsec) : error_arcsec;
}

}  // namespace zlg::study
