#pragma once
// The checked claims of the paper, by the part of it in which they stand.
//
// A verdict is on the paper, so every number in a finding is computed for the paper's own gyro, which is the default
// configuration, whatever gyro the rest of the page is for.

#include <vector>

#include <zlg/design/substitution.hpp>
#include <zlg/paper/paper.hpp>

namespace zlg::paper {

// What the paper gives of the trial with oscillation: 12000 "/s at 20 Hz, 1.6 arcsec of noise on a tick of 5 ms, which
// is taken for 3 sigma; the limit of 10 arcsec per switch.
inline constexpr design::Tone paper_oscillation{12000.0, 20.0};
inline constexpr double paper_noise_arcsec = 1.6;
inline constexpr double paper_switch_error_arcsec = 10.0;

[[nodiscard]] std::vector<Claim> claims_of_abstract();
[[nodiscard]] std::vector<Claim> claims_of_laser();         // eqs (1), (2), the perimeter loop
[[nodiscard]] std::vector<Claim> claims_of_drift();         // eqs (3) to (9), figures 3 to 5
[[nodiscard]] std::vector<Claim> claims_of_relock();        // eqs (10) to (13), tables 1 and 2
[[nodiscard]] std::vector<Claim> claims_of_substitution();  // eqs (14) to (20), figures 6 to 11
[[nodiscard]] std::vector<Claim> claims_of_conclusions();

}  // namespace zlg::paper
