#include <array>
#include <limits>

#include <zlg/core/records.hpp>

#include "key.hpp"

namespace zlg::config {

namespace {

using C = Config;

// The names of the enumerators of each choice, in the order of its enumeration: a name stands for the number of its
// place.
constexpr std::array<std::string_view, 3> loops{"analog", "exponential", "digital"};
constexpr std::array<std::string_view, 4> dithers{"none", "auto", "paired", "random"};
constexpr std::array<std::string_view, 3> fidelities{"averaged", "laser", "events"};
constexpr std::array<std::string_view, 2> quadratures{"x1", "x4"};
constexpr std::array<std::string_view, 2> readouts{"count", "phase"};
constexpr std::array<std::string_view, 2> first_segments{"full", "half"};
constexpr std::array<std::string_view, 2> schedules{"fixed", "measured"};
constexpr std::array<std::string_view, 3> magnetics{"none", "watch", "estimate"};
constexpr std::array<std::string_view, 5> relocks{"none", "frequency", "detuning", "mean_square", "joint"};
constexpr std::array<std::string_view, 5> bridges{"none", "constant", "linear", "quadratic", "auto"};
constexpr std::array<std::string_view, 5> motions{"rest", "constant", "sine", "sum", "file"};
constexpr std::array<std::string_view, 5> fields{"none", "constant", "sine", "steps", "file"};
constexpr std::array<std::string_view, 2> column_holds{"increment", "rate"};

constexpr std::array<std::string_view, 9> deviations{"adev",  "oadev",  "mdev",    "tdev",   "hdev",
                                                     "ohdev", "totdev", "mtotdev", "htotdev"};
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

// Ranges are those in which the arithmetic has a meaning, not those of a typical gyro.
const Key table[] = {
    {"run", "duration_s", "s", "length of the run; unset: 3600, or the length of the motion file",
     OptionalReal{at<&C::run, &Run::duration_s>, {.min = 0.0, .max = 1e9, .without_min = true}}},
    {"run", "seed", "", "seed of all random numbers; the same seed gives the same run",
     integer<&C::run, &Run::seed>(0, int64_max)},

    {"gyro", "fidelity", "",
     "physics of a simulated gyro: given by [gyro] and [drift], derived from [laser], or the first with "
     "closed-form steps from event to event",
     choice<&C::gyro, &Gyro::fidelity>(fidelities)},
    {"gyro", "tick_s", "s", "length of a tick: two half-periods of the bias",
     Real{at<&C::gyro, &Gyro::tick_s>, {.min = 1e-6, .max = 10.0}}},
    {"gyro", "scale_arcsec", "arcsec", "angle per count",
     Real{at<&C::gyro, &Gyro::scale_arcsec>, {.min = 1e-6, .max = 1e6}}},
    {"gyro", "bias_hz", "Hz", "bias frequency, mean over a half as the counter sees it, at zero detuning",
     Real{at<&C::gyro, &Gyro::bias_hz>, {.min = 0.0, .max = 1e12, .without_min = true}}},
    {"gyro", "bias_chi", "", "loss of bias frequency: bias_hz (1 - bias_chi detuning^2), the detuning in wavelengths",
     Real{at<&C::gyro, &Gyro::bias_chi>, {.min = -1e6, .max = 1e6}}},
    {"gyro", "bias_chi_higher", "", "of that loss the coefficients of detuning^4, ^6 and ^8; unset: 0",
     RealList{at<&C::gyro, &Gyro::bias_chi_higher>, {.min = -1e9, .max = 1e9}, true}},
    {"gyro", "bias_edge_s", "s", "duration of a reversal of the bias field; below half a tick",
     Real{at<&C::gyro, &Gyro::bias_edge_s>, non_negative}},
    {"gyro", "first_bias_sign", "", "sign of the bias in the first half of every tick",
     sign<&C::gyro, &Gyro::first_bias_sign>()},
    {"gyro", "reference_temperature_c", "C", "temperature at which bias_hz holds",
     Real{at<&C::gyro, &Gyro::reference_temperature_c>, within_a_million}},
    {"gyro", "temperature_rise_c", "C", "warming of the gyro in operation, approached with drift.thermal_time_s",
     Real{at<&C::gyro, &Gyro::temperature_rise_c>, any_finite}},
    {"gyro", "bias_temperature_coefficient_per_c", "1/C", "relative change of the bias frequency with temperature",
     Real{at<&C::gyro, &Gyro::bias_temperature_coefficient_per_c>, {.min = -1.0, .max = 1.0}}},
    {"gyro", "bias_temperature_table", "C, 1",
     "pairs [temperature, relative change of the bias frequency], straight between them, even before and after them; "
     "the processor presumes the line of bias_temperature_coefficient_per_c; unset: so does the gyro",
     Points{at<&C::gyro, &Gyro::bias_temperature_table>}},
    {"gyro", "light_samples", "", "samples of the light in a half",
     integer<&C::gyro, &Gyro::light_samples>(1, core::max_light_samples)},
    {"gyro", "light_noise_lambda", "lambda", "noise of one light sample, white, as detuning",
     Real{at<&C::gyro, &Gyro::light_noise_lambda>, {.min = 0.0, .max = 10.0}}},
    {"gyro", "discriminator_per_lambda", "1/lambda", "(I1 - I2)/(I1 + I2) per wavelength of detuning",
     Real{at<&C::gyro, &Gyro::discriminator_per_lambda>, slope}},
    {"gyro", "dither", "", "shifts of the bias edges against lock-in; auto: paired at low rates, random at high ones",
     choice<&C::gyro, &Gyro::dither>(dithers)},

    {"gyro", "readout", "",
     "what is latched of the beat: whole counts, or with both photodiodes the place within the fringe too",
     choice<&C::gyro, &Gyro::readout>(readouts)},

    {"laser", "perimeter_m", "m", "length of the ring",
     Real{at<&C::laser, &Laser::perimeter_m>, {.min = 1e-3, .max = 1e3}}},
    {"laser", "round_trip_loss_ratio", "", "light lost in one round trip",
     Real{at<&C::laser, &Laser::round_trip_loss_ratio>, {.min = 1e-9, .max = 0.5}}},
    {"laser", "gain_loss_ratio", "", "unsaturated gain over loss, at the centre without field",
     Real{at<&C::laser, &Laser::gain_loss_ratio>, {.min = 1e-6, .max = 100.0}}},
    {"laser", "doppler_half_width_hz", "Hz", "where the velocity distribution falls to 1/e",
     Real{at<&C::laser, &Laser::doppler_half_width_hz>, {.min = 1e6, .max = 1e12}}},
    {"laser", "homogeneous_half_width_hz", "Hz", "where the line of an atom at rest falls to 1/2",
     Real{at<&C::laser, &Laser::homogeneous_half_width_hz>, {.min = 1e4, .max = 1e13}}},
    {"laser", "isotope_shift_hz", "Hz", "distance of the centres of both neon isotopes",
     Real{at<&C::laser, &Laser::isotope_shift_hz>, {.min = 0.0, .max = 1e13}}},
    {"laser", "upper_isotope_ratio", "", "share of the isotope with the higher frequency, neon 22",
     Real{at<&C::laser, &Laser::upper_isotope_ratio>, {.min = 0.0, .max = 1.0}}},
    {"laser", "zeeman_hz_per_g", "Hz/G", "shift of one circular component of the line by the field",
     Real{at<&C::laser, &Laser::zeeman_hz_per_g>, {.min = 0.0, .max = 1e12}}},
    {"laser", "opposite_sigma_coupling", "",
     "cross-saturation of waves on opposite components over that on the same one",
     Real{at<&C::laser, &Laser::opposite_sigma_coupling>, {.min = 0.0, .max = 1.0}}},
    {"laser", "bias_field_g", "G", "plateau of the bias field at gyro.reference_temperature_c",
     Real{at<&C::laser, &Laser::bias_field_g>, {.min = 1e-6, .max = 1e4}}},
    {"laser", "beam_power_w", "W",
     "light that either beam loses in all, at zero detuning and field: its quantum noise; 0: none",
     Real{at<&C::laser, &Laser::beam_power_w>, {.min = 0.0, .max = 1e3}}},
    {"laser", "lock_in_left_hz", "Hz", "beat frequency below which equal waves of the left mode lock",
     Real{at<&C::laser, &Laser::lock_in_left_hz>, {.min = 0.0, .max = 1e6}}},
    {"laser", "lock_in_right_hz", "Hz", "beat frequency below which equal waves of the right mode lock",
     Real{at<&C::laser, &Laser::lock_in_right_hz>, {.min = 0.0, .max = 1e6}}},
    {"laser", "quadrature", "",
     "counts a fringe; gyro.scale_arcsec and gyro.bias_hz are those of counts: x4 takes a quarter and four times of "
     "x1's",
     choice<&C::laser, &Laser::quadrature>(quadratures)},

    {"drift", "magnetic_arcsec_s", "arcsec/s", "drift that changes its sign with the mode, at the start",
     Real{at<&C::drift, &Drift::magnetic_arcsec_s>, any_finite}},
    {"drift", "magnetic_thermal_arcsec_s", "arcsec/s", "growth of the magnetic drift by warming",
     Real{at<&C::drift, &Drift::magnetic_thermal_arcsec_s>, any_finite}},
    {"drift", "thermal_time_s", "s", "time constant of the warming",
     Real{at<&C::drift, &Drift::thermal_time_s>, positive}},
    {"drift", "nonmagnetic_arcsec_s", "arcsec/s", "drift that is the same in both modes",
     Real{at<&C::drift, &Drift::nonmagnetic_arcsec_s>, any_finite}},
    {"drift", "random_walk_arcsec_sqrt_s", "arcsec/sqrt(s)",
     "random walk of the angle; what makes it in fidelity laser is lock-in and quantum noise, and this only what is "
     "presumed",
     Real{at<&C::drift, &Drift::random_walk_arcsec_sqrt_s>, {.min = 0.0, .max = 1e6}}},

    {"temperature", "profile", "s, C",
     "temperature of the gyro, straight between the points, even before and after them; a file has a column of times "
     "and one of temperatures; unset: gyro.temperature_rise_c and drift.thermal_time_s tell it",
     Points{at<&C::temperature, &Temperature::profile>}},
    {"temperature", "sensor_lag_s", "s", "time constant of the sensor behind the gyro",
     Real{at<&C::temperature, &Temperature::sensor_lag_s>, {.min = 0.0, .max = 1e6}}},
    {"temperature", "sensor_error_c", "C", "by which the sensor says too much",
     Real{at<&C::temperature, &Temperature::sensor_error_c>, {.min = -1e3, .max = 1e3}}},

    {"field", "kind", "",
     "magnetic field that the gyro is in, and that makes its magnetic drift; none: drift.magnetic_arcsec_s and "
     "magnetic_thermal_arcsec_s tell that",
     choice<&C::field, &Field::kind>(fields)},
    {"field", "field_g", "G", "the field, for kind constant; its amplitude, for kind sine",
     Real{at<&C::field, &Field::field_g>, presumed_drift}},
    {"field", "frequency_hz", "Hz", "for kind sine",
     Real{at<&C::field, &Field::frequency_hz>, {.min = 0.0, .max = 1e6}}},
    {"field", "course", "s, G",
     "for kind steps the field from each time on; for kind file the path, columns of times and of the field, straight "
     "between the rows",
     Points{at<&C::field, &Field::course>}},
    {"field", "sensitivity_arcsec_s_g", "arcsec/(s G)", "magnetic drift by the field, at gyro.reference_temperature_c",
     Real{at<&C::field, &Field::sensitivity_arcsec_s_g>, presumed_drift}},
    {"field", "sensitivity_per_c", "1/C", "relative change of that sensitivity with temperature",
     Real{at<&C::field, &Field::sensitivity_per_c>, {.min = -1.0, .max = 1.0}}},

    {"perimeter", "loop", "", "control of the perimeter", choice<&C::perimeter, &Perimeter::loop>(loops)},
    {"perimeter", "tau_s", "s", "time constant of the loop",
     Real{at<&C::perimeter, &Perimeter::tau_s>, {.min = 1e-6, .max = 1e6}}},
    {"perimeter", "limit_lambda", "lambda", "detuning at which the error signal is limited",
     Real{at<&C::perimeter, &Perimeter::limit_lambda>, {.min = 0.0, .max = 1e3, .without_min = true}}},
    {"perimeter", "miss_lambda", "lambda",
     "detuning when the loop closes after a switch, all causes included; 0: what comes of itself",
     Real{at<&C::perimeter, &Perimeter::miss_lambda>, {.min = 0.0, .max = 0.24, .without_max = true}}},
    {"perimeter", "expansion_lambda_per_c", "lambda/C", "growth of the perimeter with temperature",
     Real{at<&C::perimeter, &Perimeter::expansion_lambda_per_c>, any_finite}},
    {"perimeter", "relock_halves", "",
     "digital loop: halves after closing in which it corrects nearly all it sees; 0: the plain integrator of tau_s",
     integer<&C::perimeter, &Perimeter::relock_halves>(0, 1000000)},
    {"perimeter", "discriminator_detuning_lambda", "lambda",
     "calibrated points of the discriminator besides 0, growing, 31 at most on a side; those above 0 alone: the "
     "other side is their mirror image; none: gyro.discriminator_per_lambda alone",
     RealList{at<&C::perimeter, &Perimeter::discriminator_detuning_lambda>, curve_node, true}},
    {"perimeter", "discriminator_signal", "",
     "(I1 - I2)/(I1 + I2) at each of these detunings, of the same sign, growing",
     RealList{at<&C::perimeter, &Perimeter::discriminator_signal>, curve_node, true}},
    {"perimeter", "discriminator_centre_lambda", "lambda",
     "detuning, on that scale, at which the bias is largest: bias_hz (1 - bias_chi (detuning - centre)^2)",
     Real{at<&C::perimeter, &Perimeter::discriminator_centre_lambda>, curve_centre}},

    {"piezo", "half_wave_v", "V",
     "voltage that moves the perimeter by half a wavelength, at gyro.reference_temperature_c",
     Real{at<&C::piezo, &Piezo::half_wave_v>, {.min = 1e-3, .max = 1e6}}},
    {"piezo", "half_wave_temperature_coefficient_per_c", "1/C",
     "relative change of the half-wave voltage with temperature",
     Real{at<&C::piezo, &Piezo::half_wave_temperature_coefficient_per_c>, any_finite}},
    {"piezo", "half_wave_error", "", "relative error of the half-wave voltage that control presumes at first",
     Real{at<&C::piezo, &Piezo::half_wave_error>, {.min = -0.9, .max = 0.9}}},
    {"piezo", "rc_s", "s", "time constant of the high-voltage stage",
     Real{at<&C::piezo, &Piezo::rc_s>, {.min = 1e-6, .max = 1e3}}},
    {"piezo", "slew_v_s", "V/s", "fastest change of the high voltage",
     Real{at<&C::piezo, &Piezo::slew_v_s>, {.min = 0.0, .max = 1e12, .without_min = true}}},
    {"piezo", "range_min_v", "V", "lower end of the high voltage",
     Real{at<&C::piezo, &Piezo::range_min_v>, within_a_million}},
    {"piezo", "range_max_v", "V", "upper end of the high voltage; above the lower",
     Real{at<&C::piezo, &Piezo::range_max_v>, within_a_million}},
    {"piezo", "hysteresis", "", "width of a voltage loop of piezo.hysteresis_stroke_v over its height; 0: none",
     Real{at<&C::piezo, &Piezo::hysteresis>, {.min = 0.0, .max = 0.4}}},
    {"piezo", "hysteresis_stroke_v", "V", "stroke of the loop to which piezo.hysteresis refers",
     Real{at<&C::piezo, &Piezo::hysteresis_stroke_v>, positive}},
    {"piezo", "creep_per_decade", "", "growth of a stroke per decade of time, from 10 ms to 10^4 s; 0: none",
     Real{at<&C::piezo, &Piezo::creep_per_decade>, {.min = 0.0, .max = 0.05}}},
    {"piezo", "mirror_hz", "Hz", "resonance of the mirror; 0: rigid, else 100 or more",
     Real{at<&C::piezo, &Piezo::mirror_hz>, {.min = 100.0, .max = 1e6, .or_zero = true}}},

    {"light", "gain_b", "", "photodiode of beam B over that of beam A at t = 0",
     Real{at<&C::light, &Light::gain_b>, {.min = 0.01, .max = 100.0}}},
    {"light", "gain_drift_per_h", "1/h", "drift of gain_b: at t it is gain_b (1 + gain_drift_per_h t)",
     Real{at<&C::light, &Light::gain_drift_per_h>, {.min = -1e3, .max = 1e3}}},
    {"light", "offset_a", "", "of the photodiode of beam A, over the mean light at t = 0",
     Real{at<&C::light, &Light::offset_a>, diode_offset}},
    {"light", "offset_b", "", "of the photodiode of beam B, over the mean light at t = 0",
     Real{at<&C::light, &Light::offset_b>, diode_offset}},
    {"light", "power_decay_per_h", "1/h", "both beams fall as exp(-power_decay_per_h t)",
     Real{at<&C::light, &Light::power_decay_per_h>, {.min = 0.0, .max = 1e3}}},

    {"photodiodes", "offset_cosine", "", "offset of the cosine's photodiode, over the amplitude of the beat",
     Real{at<&C::photodiodes, &Photodiodes::offset_cosine>, diode_offset}},
    {"photodiodes", "offset_sine", "", "offset of the sine's photodiode, over the amplitude of the beat",
     Real{at<&C::photodiodes, &Photodiodes::offset_sine>, diode_offset}},
    {"photodiodes", "amplitude_error", "", "amplitude of the sine's photodiode over the cosine's, less 1",
     Real{at<&C::photodiodes, &Photodiodes::amplitude_error>, {.min = -1.0, .max = 0.5}}},
    {"photodiodes", "angle_error_deg", "deg", "angle between the photodiodes, less 90",
     Real{at<&C::photodiodes, &Photodiodes::angle_error_deg>, {.min = -90.0, .max = 90.0}}},
    {"photodiodes", "noise", "", "noise of one sample, white, over the amplitude of the beat; also what is presumed",
     Real{at<&C::photodiodes, &Photodiodes::noise>, {.min = 0.0, .max = 1.0}}},
    {"photodiodes", "adc_bits", "", "resolution of the samples, for twice the amplitude of either sign",
     integer<&C::photodiodes, &Photodiodes::adc_bits>(1, 24)},

    {"switching", "interval_s", "s",
     "from one opening of the loop to the next; at least gap_ticks + 2 ticks, and no shorter than the loop needs to "
     "lock anew",
     Interval{long_interval}},
    {"switching", "first_segment", "", "length of the first segment: an interval or half of one",
     choice<&C::switching, &Switching::first_segment>(first_segments)},
    {"switching", "schedule", "",
     "fixed: a grid of interval_s; measured: with the cube root of time, by the errors of the switches and the drift "
     "that compensation finds",
     choice_of<&C::switching, &Switching::schedule, Schedule::fixed, Schedule::measured>(schedules)},
    {"switching", "interval_min_s", "s", "shortest interval of a schedule that is not fixed",
     Real{at<&C::switching, &Switching::interval_min_s>, long_interval}},
    {"switching", "interval_max_s", "s", "longest interval of a schedule that is not fixed",
     Real{at<&C::switching, &Switching::interval_max_s>, long_interval}},
    {"switching", "gap_ticks", "", "ticks for which the loop stays open at a switch",
     integer<&C::switching, &Switching::gap_ticks>(1, 40)},
    {"switching", "gap_min_ticks", "",
     "from so many ticks on the loop closes as soon as light and piezo have arrived; up to gap_ticks, 0: gap_ticks",
     integer<&C::switching, &Switching::gap_min_ticks>(0, 40)},

    {"compensation", "relock", "",
     "correction of the false drift after closing; unset: mean_square where the log has detuning, none where not",
     optional_choice<&C::compensation, &Compensation::relock>(relocks)},
    {"compensation", "relock_ticks", "", "ticks after closing that are corrected",
     integer<&C::compensation, &Compensation::relock_ticks>(0, 64)},
    {"compensation", "bridge", "", "what replaces the ticks of a gap",
     choice_of<&C::compensation, &Compensation::bridge, core::BridgeMethod::none, core::BridgeMethod::constant,
               core::BridgeMethod::linear, core::BridgeMethod::quadratic, core::BridgeMethod::automatic>(bridges)},
    {"compensation", "extrapolation_points", "", "measured ticks before a gap from which it is extrapolated",
     integer<&C::compensation, &Compensation::extrapolation_points>(1, 8)},
    {"compensation", "points_before", "", "measured ticks before a gap from which it is interpolated",
     integer<&C::compensation, &Compensation::points_before>(1, 8)},
    {"compensation", "points_after", "", "measured ticks after a gap from which it is interpolated",
     integer<&C::compensation, &Compensation::points_after>(1, 8)},
    {"compensation", "magnetic", "",
     "drift that changes its sign with the mode: left in the angle, estimated only, or estimated and taken out",
     choice<&C::compensation, &Compensation::magnetic>(magnetics)},
    {"compensation", "magnetic_arcsec_s", "arcsec/s", "that drift at the start, by calibration",
     Real{at<&C::compensation, &Compensation::magnetic_arcsec_s>, presumed_drift}},
    {"compensation", "magnetic_sigma_arcsec_s", "arcsec/s",
     "standard deviation of magnetic_arcsec_s; the default is that of no calibration",
     Real{at<&C::compensation, &Compensation::magnetic_sigma_arcsec_s>, drift_sigma}},
    {"compensation", "magnetic_thermal_arcsec_s", "arcsec/s", "growth of that drift by warming, by calibration",
     Real{at<&C::compensation, &Compensation::magnetic_thermal_arcsec_s>, presumed_drift}},
    {"compensation", "magnetic_thermal_sigma_arcsec_s", "arcsec/s",
     "standard deviation of magnetic_thermal_arcsec_s; the default is that of no calibration",
     Real{at<&C::compensation, &Compensation::magnetic_thermal_sigma_arcsec_s>, drift_sigma}},
    {"compensation", "magnetic_thermal_time_s", "s", "time constant of the warming, presumed",
     Real{at<&C::compensation, &Compensation::magnetic_thermal_time_s>, {.min = 1e-9, .max = 1e12}}},
    {"compensation", "lock_in_hz", "Hz",
     "beat frequency below which the waves lock, by calibration: what it takes from the counts is put back; 0: nothing "
     "is",
     Real{at<&C::compensation, &Compensation::lock_in_hz>, {.min = 0.0, .max = 1e6}}},
    {"compensation", "lock_in_sigma_hz", "Hz",
     "standard deviation of lock_in_hz; the default is that of no calibration",
     Real{at<&C::compensation, &Compensation::lock_in_sigma_hz>, {.min = 0.0, .max = 1e6}}},

    {"motion", "kind", "", "how the gyro is turned", choice<&C::motion, &Motion::kind>(motions)},
    {"motion", "rate_arcsec_s", "arcsec/s", "constant rate; added to sine and sum",
     Real{at<&C::motion, &Motion::rate_arcsec_s>, any_finite}},
    {"motion", "amplitude_arcsec_s", "arcsec/s", "amplitudes of the rate; one for sine, one or more for sum",
     RealList{at<&C::motion, &Motion::amplitude_arcsec_s>, any_finite}},
    {"motion", "frequency_hz", "Hz", "frequencies, as many as amplitudes",
     RealList{at<&C::motion, &Motion::frequency_hz>, {.min = 0.0, .max = 1e9}}},
    {"motion", "phase_deg", "deg", "phases at the start, as many as amplitudes",
     RealList{at<&C::motion, &Motion::phase_deg>, any_finite}},
    {"motion", "path", "", "the motion file, for kind file", Text{at<&C::motion, &Motion::path>}},
    {"motion", "column", "", "column of the file, by its number from 1 or its name; unset: 1, but no column of times",
     Column{at<&C::motion, &Motion::column>}},
    {"motion", "column_holds", "", "whether the column holds angle increments or rates",
     choice<&C::motion, &Motion::column_holds>(column_holds)},
    {"motion", "scale_arcsec", "arcsec", "angle (or rate in arcsec/s) per unit of the column",
     Real{at<&C::motion, &Motion::scale_arcsec>, non_zero}},
    {"motion", "rate_hz", "Hz", "rows of the file per second", Real{at<&C::motion, &Motion::rate_hz>, positive}},
    {"motion", "comment", "", "lines of the file that begin with this are skipped",
     Text{at<&C::motion, &Motion::comment>}},
    {"motion", "skip_lines", "", "lines of numbers to skip at the head of the file",
     integer<&C::motion, &Motion::skip_lines>(0, int32_max)},
    {"motion", "separator", "", "what parts the columns of the file; auto: recognised, together with the decimal mark",
     choice<&C::motion, &Motion::separator>(separators)},
    {"motion", "decimal", "", "decimal mark of the file; auto: recognised, together with the separator",
     choice<&C::motion, &Motion::decimal>(decimal_marks)},
    {"motion", "time_column", "",
     "column with the time of each row, against which rate_hz is checked; 0: none; unset: looked for",
     Column{at<&C::motion, &Motion::time_column>, true}},

    {"faults", "kind", "", "what breaks in a simulated gyro, fault by fault",
     choice_list<&C::faults, &Faults::kind>(twin::fault_kind_names)},
    {"faults", "at_s", "s", "when each begins", RealList{at<&C::faults, &Faults::at_s>, fault_time, true}},
    {"faults", "duration_s", "s", "how long each lasts",
     RealList{at<&C::faults, &Faults::duration_s>, fault_time, true}},
    {"faults", "size", "", "how large each is, in the unit of its kind",
     RealList{at<&C::faults, &Faults::size>, any_finite, true}},
    {"faults", "random_per_hour", "1/h", "more of them at random moments",
     Real{at<&C::faults, &Faults::random_per_hour>, {.min = 0.0, .max = 1e6}}},
    {"faults", "random_seed", "", "seed of their moments, kinds, durations and sizes",
     integer<&C::faults, &Faults::random_seed>(0, int64_max)},
    {"faults", "random_kinds", "", "their kinds; none: all",
     choice_list<&C::faults, &Faults::random_kinds>(twin::fault_kind_names)},

    {"design", "switch_error_arcsec", "arcsec",
     "error of the angle that one switch leaves: the dP of the paper's budgets; given, also the rms for interval_s = "
     "\"optimal\", which else is found by a trial on the twin",
     Real{at<&C::design, &Design::switch_error_arcsec>, non_negative}},
    {"design", "run_lengths_s", "s", "lengths of run for which the design is worked out",
     RealList{at<&C::design, &Design::run_lengths_s>, positive}},

    {"analysis", "deviations", "", "which deviations are computed; the first is the one that is drawn",
     choice_list<&C::analysis, &Analysis::deviations>(deviations)},
    {"analysis", "taus", "", "averaging times: octave, decade (1, 2, 4, 10), all",
     choice<&C::analysis, &Analysis::taus>(tau_spacings)},
    {"analysis", "taus_s", "s", "averaging times, instead of taus",
     RealList{at<&C::analysis, &Analysis::taus_s>, positive, true}},
    {"analysis", "confidence", "", "of the intervals",
     Real{at<&C::analysis, &Analysis::confidence>, {.min = 0.0, .max = 0.999999, .without_min = true}}},
    {"analysis", "unit", "", "of rates in text and report; JSON has arcsec/s",
     choice<&C::analysis, &Analysis::unit>(shown_rates)},
    {"analysis", "table_settling_s", "s", "beginning of each stage of the table that is left out",
     Real{at<&C::analysis, &Analysis::table_settling_s>, non_negative}},
    {"analysis", "table_earth_arcsec_s", "arcsec/s",
     "rotation about the gyro's axis that the table does not show; the bias is then without it",
     Real{at<&C::analysis, &Analysis::table_earth_arcsec_s>, any_finite}},
};

}  // namespace

std::span<const Key> all_keys() { return table; }

const Key* find_key(std::string_view section, std::string_view name) {
    for (const Key& key : table) {
        if (key.section == section && key.name == name) return &key;
    }
    return nullptr;
}

}  // namespace zlg::config
