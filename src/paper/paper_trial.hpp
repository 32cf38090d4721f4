#pragma once
// What the paper gives of its trial with oscillation, section on the substitution of the gap.

#include <zlg/design/substitution.hpp>

namespace zlg::paper {

inline constexpr double paper_amplitude_arcsec_s = 12000.0;
inline constexpr design::Tone paper_oscillation{paper_amplitude_arcsec_s, 20.0};
inline constexpr double paper_noise_arcsec = 1.6;  // of a tick of 5 ms; read as 3 sigma
inline constexpr double paper_switch_error_arcsec = 10.0;
inline constexpr int paper_gap_ticks = 3;

}  // namespace zlg::paper
