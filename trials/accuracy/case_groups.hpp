#pragma once
// The groups of cases that have a table each: headings and captions.

#include <array>

#include <zlg/trials/accuracy.hpp>

namespace zlg::trials {

struct Group {
    CaseGroup group;
    const char* heading;
    const char* caption;
};

inline constexpr std::array<Group, 7> groups{{
    {CaseGroup::paper, "(a) The paper's case",
     "A sine of 12 000 \"/s at 20.06 Hz, gaps of 3 ticks, a miss of 0.22 wavelength that the loop removes with a "
     "constant slew and an exponential tail, 16 light samples a half with noise of 0.0033 wavelength."},
    {CaseGroup::grid, "(b) Frequency, amplitude, gap, light and miss", "The paper's case with one thing changed."},
    {CaseGroup::broadband, "(c) Random vibration",
     "Gaussian motion with a flat spectrum between the frequencies named."},
    {CaseGroup::non_stationary, "(d) Coning and shock",
     "Motion that is not stationary: its amplitude rises and falls, or it consists of shocks."},
    {CaseGroup::loops, "(f) Loops",
     "The paper's case with other ways in which the detuning decays, and with a bias scale that is not as presumed."},
    {CaseGroup::warm_up, "(g) Warm-up", "The paper's case with a magnetic drift of 0.7 \"/s that grows by A."},
    {CaseGroup::rest, "(h) Rest",
     "A constant rate of up to 15 \"/s. Roundings repeat here, so the bound for independent ones does not hold."},
}};

inline constexpr std::array<Group, 4> gap_groups{{
    {CaseGroup::gap_lengths, "(j) Gaps of 1 to 10 ticks",
     "Switches come 3 to 3.4 s apart; the tones have 12 000 \"/s each."},
    {CaseGroup::first_gap, "(k) The first gap",
     "The first gap of a log, at a random tick of those named. Tones of 12 000 \"/s. By phase the ellipse of the "
     "photodiodes is not known at the start."},
    {CaseGroup::phase, "(m) The phase of the fringe",
     "Photodiodes with offsets of 10 %, amplitudes that differ by 10 %, 5 degrees of angle, 1 % of noise and 12 bits; "
     "the core learns and corrects their ellipse. Without a random walk, but for the case that names one. Switches "
     "come 5 to 5.6 s apart. The bound takes only the noise of the photodiodes in place of the rounding."},
    {CaseGroup::lit, "(n) Lit halves of a gap",
     "The last three of the six halves of a gap have counts and light, at the full miss. Switches come 5 to 5.6 s "
     "apart."},
}};

inline constexpr const char* manoeuvre_caption =
    "A gyro whose motion was even until then meets a gap and, at the same time, a manoeuvre that it has never "
    "seen: its rate changes within the duration named, from a beginning within eight ticks before the gap, in it, "
    "or within eight ticks after it, or it has changed within the eight ticks before. Gaps of 3 ticks, a miss of 0.22 "
    "wavelength.";

inline constexpr const char* change_caption =
    "Until the opening of the gap the motion is even, from there on it is another one, with a phase of its own. 10 Hz "
    "and 20 Hz are sines of 12 000 \"/s. Gaps of 3 ticks, a miss of 0.22 wavelength.";

}  // namespace zlg::trials
