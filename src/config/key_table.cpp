#include <array>
#include <limits>

#include <zlg/core/records.hpp>

#include "key.hpp"

namespace zlg::config {

namespace {

// The names of the enumerators of each choice, in the order of its enumeration: a name stands for the number of its
// place.
constexpr std::array<std::string_view, 3> loops{"analog", "exponential", "digital"};
constexpr std::array<std::string_view, 4> dithers{"none", "auto", "paired", "random"};
constexpr std::array<std::string_view, 3> fidelities{"averaged", "laser", "events"};
constexpr std::array<std::string_view, 2> quadratures{"x1", "x4"};
constexpr std::array<std::string_view, 2> dispersions{"unsaturated", "saturated"};
constexpr std::array<std::string_view, 2> readouts{"count", "phase"};
constexpr std::array<std::string_view, 2> first_segments{"full", "half"};
constexpr std::array<std::string_view, 2> schedules{"fixed", "measured"};
constexpr std::array<std::string_view, 3> magnetics{"none", "watch", "estimate"};
constexpr std::array<std::string_view, 5> relocks{"none", "frequency", "detuning", "mean_square", "joint"};
constexpr std::array<std::string_view, 5> bridges{"none", "constant", "linear", "quadratic", "auto"};
constexpr std::array<std::string_view, 5> motions{"rest", "constant", "sine", "sum", "file"};
constexpr std::array<std::string_view, 5> fields{"none", "constant", "sine", "steps", "file"};
constexpr std::array<std::string_view, 2> column_holds{"increment", "rate"};

constexpr std::array<std::string_view, 7> deviations{"adev", "oadev", "mdev", "tdev", "hdev", "ohdev", "totdev"};
constexpr std::array<std::string_view, 3> tau_spacings{"octave", "decade", "all"};
constexpr std::array<std::string_view, 4> shown_rates{"deg/h", "arcsec/s", "deg/s", "rad/s"};

constexpr std::array<std::string_view, 6> separators{"auto", "space", "tab", "semicolon", "comma", "bar"};
constexpr std::array<std::string_view, 3> decimal_marks{"auto", "point", "comma"};

constexpr std::int64_t int64_max = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t int32_max = std::numeric_limits<std::int32_t>::max();

constexpr Range fault_time{.min = 0.0, .max = 1e9};

constexpr Range long_interval{.min = 0.0, .max = 1e9, .without_min = true};

constexpr Range drift_sigma{.min = 0.0, .max = 1e6};
constexpr Range presumed_drift{.min = -1e6, .max = 1e6};

constexpr Range curve_node{.min = -1e3, .max = 1e3};
constexpr Range curve_centre{.min = -0.2, .max = 0.2};
constexpr Range diode_offset{.min = -1.0, .max = 1.0};
constexpr Range slope{.min = -1e6, .max = 1e6, .min_size = 1e-6};
constexpr Range within_a_million{.min = -1e6, .max = 1e6, .without_min = true, .without_max = true};

// A key's section, name and member: each is said once. The slot is what `kind` makes of the member and of what follows.
// clang-format off
#define MEMBER(section, name) &Config::section, &decltype(Config::section)::name
#define KEY(kind, section, name, unit, meaning, ...) \
    Key{#section, #name, unit, meaning, kind{at<MEMBER(section, name)>, __VA_ARGS__}}
#define KEY_BY(kind, section, name, meaning, ...) \
    Key{#section, #name, "", meaning, kind<MEMBER(section, name)>(__VA_ARGS__)}
// clang-format on

// Ranges are those in which the arithmetic has a meaning, not those of a typical gyro.
const Key table[] = {
    KEY(OptionalReal, run, duration_s, "s", "length of the run; unset: 3600, or the length of the motion file",
        {.min = 0.0, .max = 1e9, .without_min = true}),
    KEY_BY(integer, run, seed, "seed of all random numbers; the same seed gives the same run", 0, int64_max),

    KEY_BY(choice, gyro, fidelity,
           "physics of a simulated gyro: given by [gyro] and [drift], derived from [laser], or the first with "
           "closed-form steps from event to event",
           fidelities),
    KEY(Real, gyro, tick_s, "s", "length of a tick: two half-periods of the bias", {.min = 1e-6, .max = 10.0}),
    KEY(Real, gyro, scale_arcsec, "arcsec", "angle per count", {.min = 1e-6, .max = 1e6}),
    KEY(Real, gyro, bias_hz, "Hz", "bias frequency, mean over a half as the counter sees it, at zero detuning",
        {.min = 0.0, .max = 1e12, .without_min = true}),
    KEY(Real, gyro, bias_chi, "",
        "loss of bias frequency: bias_hz (1 - bias_chi detuning^2), the detuning in wavelengths",
        {.min = -1e6, .max = 1e6}),
    KEY(RealList, gyro, bias_chi_higher, "", "of that loss the coefficients of detuning^4, ^6 and ^8; unset: 0",
        {.min = -1e9, .max = 1e9}, true),
    KEY(Real, gyro, bias_edge_s, "s", "duration of a reversal of the bias field; below half a tick", non_negative),
    KEY_BY(sign, gyro, first_bias_sign, "sign of the bias in the first half of every tick"),
    KEY(Real, gyro, reference_temperature_c, "C", "temperature at which bias_hz holds", within_a_million),
    KEY(Real, gyro, temperature_rise_c, "C", "warming of the gyro in operation, approached with drift.thermal_time_s",
        any_finite),
    KEY(Real, gyro, bias_temperature_coefficient_per_c, "1/C", "relative change of the bias frequency with temperature",
        {.min = -1.0, .max = 1.0}),
    KEY(Points, gyro, bias_temperature_table, "C, 1",
        "pairs [temperature, relative change of the bias frequency], straight between them, even before and after "
        "them; the processor presumes the line of bias_temperature_coefficient_per_c; unset: so does the gyro"),
    KEY_BY(integer, gyro, light_samples, "samples of the light in a half", 1, core::max_light_samples),
    KEY(Real, gyro, light_noise_lambda, "lambda", "noise of one light sample, white, as detuning",
        {.min = 0.0, .max = 10.0}),
    KEY(Real, gyro, discriminator_per_lambda, "1/lambda", "(I1 - I2)/(I1 + I2) per wavelength of detuning", slope),
    KEY_BY(choice, gyro, dither,
           "shifts of the bias edges against lock-in; auto: paired at low rates, random at high ones", dithers),

    KEY_BY(choice, gyro, readout,
           "what is latched of the beat: whole counts, or with both photodiodes the place within the fringe too",
           readouts),

    KEY(Real, laser, perimeter_m, "m", "length of the ring", {.min = 1e-3, .max = 1e3}),
    KEY(Real, laser, round_trip_loss_ratio, "", "light lost in one round trip", {.min = 1e-9, .max = 0.5}),
    KEY(Real, laser, gain_loss_ratio, "", "unsaturated gain over loss, at the centre without field",
        {.min = 1e-6, .max = 100.0}),
    KEY(Real, laser, doppler_half_width_hz, "Hz", "where the velocity distribution falls to 1/e",
        {.min = 1e6, .max = 1e12}),
    KEY(Real, laser, homogeneous_half_width_hz, "Hz", "where the line of an atom at rest falls to 1/2",
        {.min = 1e4, .max = 1e13}),
    KEY(Real, laser, isotope_shift_hz, "Hz", "distance of the centres of both neon isotopes",
        {.min = 0.0, .max = 1e13}),
    KEY(Real, laser, upper_isotope_ratio, "", "share of the isotope with the higher frequency, neon 22",
        {.min = 0.0, .max = 1.0}),
    KEY(Real, laser, zeeman_hz_per_g, "Hz/G", "shift of one circular component of the line by the field",
        {.min = 0.0, .max = 1e12}),
    KEY(Real, laser, opposite_sigma_coupling, "",
        "cross-saturation of waves on opposite components over that on the same one", {.min = 0.0, .max = 1.0}),
    KEY_BY(choice, laser, dispersion,
           "frequencies pulled by the gas without light, the paper's parabola, or with the holes that the waves burn",
           dispersions),
    KEY(Real, laser, bias_field_g, "G", "plateau of the bias field at gyro.reference_temperature_c",
        {.min = 1e-6, .max = 1e4}),
    KEY(Real, laser, beam_power_w, "W",
        "light that either beam loses in all, at zero detuning and field: its quantum noise; 0: none",
        {.min = 0.0, .max = 1e3}),
    KEY(Real, laser, lock_in_left_hz, "Hz", "beat frequency below which equal waves of the left mode lock",
        {.min = 0.0, .max = 1e6}),
    KEY(Real, laser, lock_in_right_hz, "Hz", "beat frequency below which equal waves of the right mode lock",
        {.min = 0.0, .max = 1e6}),
    KEY_BY(choice, laser, quadrature,
           "counts a fringe; gyro.scale_arcsec and gyro.bias_hz are those of counts: x4 takes a quarter and four times "
           "of x1's",
           quadratures),

    KEY(Real, drift, magnetic_arcsec_s, "arcsec/s", "drift that changes its sign with the mode, at the start",
        any_finite),
    KEY(Real, drift, magnetic_thermal_arcsec_s, "arcsec/s", "growth of the magnetic drift by warming", any_finite),
    KEY(Real, drift, thermal_time_s, "s", "time constant of the warming", positive),
    KEY(Real, drift, nonmagnetic_arcsec_s, "arcsec/s", "drift that is the same in both modes", any_finite),
    KEY(Real, drift, random_walk_arcsec_sqrt_s, "arcsec/sqrt(s)",
        "random walk of the angle; what makes it in fidelity laser is lock-in and quantum noise, and this only what is "
        "presumed",
        {.min = 0.0, .max = 1e6}),

    KEY(Points, temperature, profile, "s, C",
        "temperature of the gyro, straight between the points, even before and after them; a file has a column of "
        "times and one of temperatures; unset: gyro.temperature_rise_c and drift.thermal_time_s tell it"),
    KEY(Real, temperature, sensor_lag_s, "s", "time constant of the sensor behind the gyro", {.min = 0.0, .max = 1e6}),
    KEY(Real, temperature, sensor_error_c, "C", "by which the sensor says too much", {.min = -1e3, .max = 1e3}),

    KEY_BY(choice, field, kind,
           "magnetic field that the gyro is in, and that makes its magnetic drift; none: drift.magnetic_arcsec_s and "
           "magnetic_thermal_arcsec_s tell that",
           fields),
    KEY(Real, field, field_g, "G", "the field, for kind constant; its amplitude, for kind sine", presumed_drift),
    KEY(Real, field, frequency_hz, "Hz", "for kind sine", {.min = 0.0, .max = 1e6}),
    KEY(Points, field, course, "s, G",
        "for kind steps the field from each time on; for kind file the path, columns of times and of the field, "
        "straight between the rows"),
    KEY(Real, field, sensitivity_arcsec_s_g, "arcsec/(s G)",
        "magnetic drift by the field, at gyro.reference_temperature_c", presumed_drift),
    KEY(Real, field, sensitivity_per_c, "1/C", "relative change of that sensitivity with temperature",
        {.min = -1.0, .max = 1.0}),

    KEY_BY(choice, perimeter, loop, "control of the perimeter", loops),
    KEY(Real, perimeter, tau_s, "s", "time constant of the loop", {.min = 1e-6, .max = 1e6}),
    KEY(Real, perimeter, limit_lambda, "lambda", "detuning at which the error signal is limited",
        {.min = 0.0, .max = 1e3, .without_min = true}),
    KEY(Real, perimeter, miss_lambda, "lambda",
        "detuning when the loop closes after a switch, all causes included; 0: what comes of itself",
        {.min = 0.0, .max = 0.24, .without_max = true}),
    KEY(Real, perimeter, expansion_lambda_per_c, "lambda/C", "growth of the perimeter with temperature", any_finite),
    KEY_BY(
        integer, perimeter, relock_halves,
        "digital loop: halves after closing in which it corrects nearly all it sees; 0: the plain integrator of tau_s",
        0, 1000000),
    KEY(RealList, perimeter, discriminator_detuning_lambda, "lambda",
        "calibrated points of the discriminator besides 0, growing, 31 at most on a side; those above 0 alone: the "
        "other side is their mirror image; none: gyro.discriminator_per_lambda alone",
        curve_node, true),
    KEY(RealList, perimeter, discriminator_signal, "",
        "(I1 - I2)/(I1 + I2) at each of these detunings, of the same sign, growing", curve_node, true),
    KEY(Real, perimeter, discriminator_centre_lambda, "lambda",
        "detuning, on that scale, at which the bias is largest: bias_hz (1 - bias_chi (detuning - centre)^2)",
        curve_centre),

    KEY(Real, piezo, half_wave_v, "V",
        "voltage that moves the perimeter by half a wavelength, at gyro.reference_temperature_c",
        {.min = 1e-3, .max = 1e6}),
    KEY(Real, piezo, half_wave_temperature_coefficient_per_c, "1/C",
        "relative change of the half-wave voltage with temperature", any_finite),
    KEY(Real, piezo, half_wave_error, "", "relative error of the half-wave voltage that control presumes at first",
        {.min = -0.9, .max = 0.9}),
    KEY(Real, piezo, rc_s, "s", "time constant of the high-voltage stage", {.min = 1e-6, .max = 1e3}),
    KEY(Real, piezo, slew_v_s, "V/s", "fastest change of the high voltage",
        {.min = 0.0, .max = 1e12, .without_min = true}),
    KEY(Real, piezo, range_min_v, "V", "lower end of the high voltage", within_a_million),
    KEY(Real, piezo, range_max_v, "V", "upper end of the high voltage; above the lower", within_a_million),
    KEY(Real, piezo, hysteresis, "", "width of a voltage loop of piezo.hysteresis_stroke_v over its height; 0: none",
        {.min = 0.0, .max = 0.4}),
    KEY(Real, piezo, hysteresis_stroke_v, "V", "stroke of the loop to which piezo.hysteresis refers", positive),
    KEY(Real, piezo, creep_per_decade, "", "growth of a stroke per decade of time, from 10 ms to 10^4 s; 0: none",
        {.min = 0.0, .max = 0.05}),
    KEY(Real, piezo, mirror_hz, "Hz", "resonance of the mirror; 0: rigid, else 100 or more",
        {.min = 100.0, .max = 1e6, .or_zero = true}),

    KEY(Real, light, gain_b, "", "photodiode of beam B over that of beam A at t = 0", {.min = 0.01, .max = 100.0}),
    KEY(Real, light, gain_drift_per_h, "1/h", "drift of gain_b: at t it is gain_b (1 + gain_drift_per_h t)",
        {.min = -1e3, .max = 1e3}),
    KEY(Real, light, offset_a, "", "of the photodiode of beam A, over the mean light at t = 0", diode_offset),
    KEY(Real, light, offset_b, "", "of the photodiode of beam B, over the mean light at t = 0", diode_offset),
    KEY(Real, light, power_decay_per_h, "1/h", "both beams fall as exp(-power_decay_per_h t)",
        {.min = 0.0, .max = 1e3}),

    KEY(Real, photodiodes, offset_cosine, "", "offset of the cosine's photodiode, over the amplitude of the beat",
        diode_offset),
    KEY(Real, photodiodes, offset_sine, "", "offset of the sine's photodiode, over the amplitude of the beat",
        diode_offset),
    KEY(Real, photodiodes, amplitude_error, "", "amplitude of the sine's photodiode over the cosine's, less 1",
        {.min = -1.0, .max = 0.5}),
    KEY(Real, photodiodes, angle_error_deg, "deg", "angle between the photodiodes, less 90",
        {.min = -90.0, .max = 90.0}),
    KEY(Real, photodiodes, noise, "",
        "noise of one sample, white, over the amplitude of the beat; also what is presumed", {.min = 0.0, .max = 1.0}),
    KEY_BY(integer, photodiodes, adc_bits, "resolution of the samples, for twice the amplitude of either sign", 1, 24),

    {"switching", "interval_s", "s",
     "from one opening of the loop to the next; at least gap_ticks + 2 ticks, and no shorter than the loop needs to "
     "lock anew",
     Interval{long_interval}},
    KEY_BY(choice, switching, first_segment, "length of the first segment: an interval or half of one", first_segments),
    KEY_BY(choice, switching, schedule,
           "fixed: a grid of interval_s; measured: with the cube root of time, by the errors of the switches and the "
           "drift that compensation finds",
           schedules),
    KEY(Real, switching, interval_min_s, "s", "shortest interval of a schedule that is not fixed", long_interval),
    KEY(Real, switching, interval_max_s, "s", "longest interval of a schedule that is not fixed", long_interval),
    KEY_BY(integer, switching, gap_ticks, "ticks for which the loop stays open at a switch", 1, 40),
    KEY_BY(
        integer, switching, gap_min_ticks,
        "from so many ticks on the loop closes as soon as light and piezo have arrived; up to gap_ticks, 0: gap_ticks",
        0, 40),

    KEY_BY(optional_choice, compensation, relock,
           "correction of the false drift after closing; unset: mean_square where the log has detuning, none where not",
           relocks),
    KEY_BY(integer, compensation, relock_ticks, "ticks after closing that are corrected", 0, 64),
    KEY_BY(choice, compensation, bridge, "what replaces the ticks of a gap", bridges),
    KEY_BY(integer, compensation, extrapolation_points, "measured ticks before a gap from which it is extrapolated", 1,
           8),
    KEY_BY(integer, compensation, points_before, "measured ticks before a gap from which it is interpolated", 1, 8),
    KEY_BY(integer, compensation, points_after, "measured ticks after a gap from which it is interpolated", 1, 8),
    KEY_BY(choice, compensation, magnetic,
           "drift that changes its sign with the mode: left in the angle, estimated only, or estimated and taken out",
           magnetics),
    KEY(Real, compensation, magnetic_arcsec_s, "arcsec/s", "that drift at the start, by calibration", presumed_drift),
    KEY(Real, compensation, magnetic_sigma_arcsec_s, "arcsec/s",
        "standard deviation of magnetic_arcsec_s; the default is that of no calibration", drift_sigma),
    KEY(Real, compensation, magnetic_thermal_arcsec_s, "arcsec/s", "growth of that drift by warming, by calibration",
        presumed_drift),
    KEY(Real, compensation, magnetic_thermal_sigma_arcsec_s, "arcsec/s",
        "standard deviation of magnetic_thermal_arcsec_s; the default is that of no calibration", drift_sigma),
    KEY(Real, compensation, magnetic_thermal_time_s, "s", "time constant of the warming, presumed",
        {.min = 1e-9, .max = 1e12}),
    KEY(Real, compensation, lock_in_hz, "Hz",
        "beat frequency below which the waves lock, by calibration: what it takes from the counts is put back; 0: "
        "nothing is",
        {.min = 0.0, .max = 1e6}),
    KEY(Real, compensation, lock_in_sigma_hz, "Hz",
        "standard deviation of lock_in_hz; the default is that of no calibration", {.min = 0.0, .max = 1e6}),

    KEY_BY(choice, motion, kind, "how the gyro is turned", motions),
    KEY(Real, motion, rate_arcsec_s, "arcsec/s", "constant rate; added to sine and sum", any_finite),
    KEY(RealList, motion, amplitude_arcsec_s, "arcsec/s", "amplitudes of the rate; one for sine, one or more for sum",
        any_finite),
    KEY(RealList, motion, frequency_hz, "Hz", "frequencies, as many as amplitudes", {.min = 0.0, .max = 1e9}),
    KEY(RealList, motion, phase_deg, "deg", "phases at the start, as many as amplitudes", any_finite),
    KEY(Text, motion, path, "", "the motion file, for kind file"),
    KEY(Column, motion, column, "",
        "column of the file, by its number from 1 or its name; unset: 1, but no column of times"),
    KEY_BY(choice, motion, column_holds, "whether the column holds angle increments or rates", column_holds),
    KEY(Real, motion, scale_arcsec, "arcsec", "angle (or rate in arcsec/s) per unit of the column", non_zero),
    KEY(Real, motion, rate_hz, "Hz", "rows of the file per second", positive),
    KEY(Text, motion, comment, "", "lines of the file that begin with this are skipped"),
    KEY_BY(integer, motion, skip_lines, "lines of numbers to skip at the head of the file", 0, int32_max),
    KEY_BY(choice, motion, separator,
           "what parts the columns of the file; auto: recognised, together with the decimal mark", separators),
    KEY_BY(choice, motion, decimal, "decimal mark of the file; auto: recognised, together with the separator",
           decimal_marks),
    KEY(Column, motion, time_column, "",
        "column with the time of each row, against which rate_hz is checked; 0: none; unset: looked for", true),

    KEY_BY(choice_list, faults, kind, "what breaks in a simulated gyro, fault by fault", twin::fault_kind_names),
    KEY(RealList, faults, at_s, "s", "when each begins", fault_time, true),
    KEY(RealList, faults, duration_s, "s", "how long each lasts", fault_time, true),
    KEY(RealList, faults, size, "", "how large each is, in the unit of its kind", any_finite, true),
    KEY(Real, faults, random_per_hour, "1/h", "more of them at random moments", {.min = 0.0, .max = 1e6}),
    KEY_BY(integer, faults, random_seed, "seed of their moments, kinds, durations and sizes", 0, int64_max),
    KEY_BY(choice_list, faults, random_kinds, "their kinds; none: all", twin::fault_kind_names),

    KEY(Real, design, switch_error_arcsec, "arcsec",
        "error of the angle that one switch leaves: the dP of the paper's budgets; given, also the rms for interval_s "
        "= \"optimal\", which else is found by a trial on the twin",
        non_negative),
    KEY(RealList, design, run_lengths_s, "s", "lengths of run for which the design is worked out", positive),

    KEY_BY(choice_list, analysis, deviations, "which deviations are computed; the first is the one that is drawn",
           deviations),
    KEY_BY(choice, analysis, taus, "averaging times: octave, decade (1, 2, 4, 10), all", tau_spacings),
    KEY(RealList, analysis, taus_s, "s", "averaging times, instead of taus", positive, true),
    KEY(Real, analysis, confidence, "", "of the intervals", {.min = 0.0, .max = 0.999999, .without_min = true}),
    KEY_BY(choice, analysis, unit, "of rates in text and report; JSON has arcsec/s", shown_rates),
    KEY(Real, analysis, table_settling_s, "s", "beginning of each stage of the table that is left out", non_negative),
    KEY(Real, analysis, table_earth_arcsec_s, "arcsec/s",
        "rotation about the gyro's axis that the table does not show; the bias is then without it", any_finite),
};

#undef MEMBER
#undef KEY
#undef KEY_BY

}  // namespace

std::span<const Key> all_keys() { return table; }

const Key* find_key(std::string_view section, std::string_view name) {
    for (const Key& key : table) {
        if (key.section == section && key.name == name) return &key;
    }
    return nullptr;
}

}  // namespace zlg::config
