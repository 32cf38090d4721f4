#include <array>
#include <limits>

#include "key.hpp"

namespace zlg::config {

namespace {

using C = Config;

constexpr std::array<std::string_view, 3> loops{"analog", "exponential", "digital"};
constexpr std::array<std::string_view, 2> first_segments{"full", "half"};
constexpr std::array<std::string_view, 4> relocks{"none", "frequency", "detuning", "mean_square"};
constexpr std::array<std::string_view, 4> bridges{"none", "constant", "linear", "quadratic"};
constexpr std::array<std::string_view, 5> motions{"rest", "constant", "sine", "sum", "file"};
constexpr std::array<std::string_view, 2> column_holds{"increment", "rate"};

constexpr std::int64_t int64_max = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t int32_max = std::numeric_limits<std::int32_t>::max();

// Ranges are those in which the arithmetic has a meaning, not those of a typical gyro.
const Key table[] = {
    {"run", "duration_s", "s", "length of the run; unset: 3600, or the length of the motion file",
     OptionalReal{at<&C::run, &Run::duration_s>, {.min = 0.0, .max = 1e9, .without_min = true}}},
    {"run", "seed", "", "seed of all random numbers; the same seed gives the same run",
     Integer{at<&C::run, &Run::seed>, 0, int64_max}},

    {"gyro", "tick_s", "s", "length of a tick: two half-periods of the bias",
     Real{at<&C::gyro, &Gyro::tick_s>, {.min = 1e-6, .max = 10.0}}},
    {"gyro", "scale_arcsec", "arcsec", "angle per count",
     Real{at<&C::gyro, &Gyro::scale_arcsec>, {.min = 1e-6, .max = 1e6}}},
    {"gyro", "bias_hz", "Hz", "bias frequency, mean over a half as the counter sees it, at zero detuning",
     Real{at<&C::gyro, &Gyro::bias_hz>, {.min = 0.0, .max = 1e12, .without_min = true}}},
    {"gyro", "bias_chi", "", "loss of bias frequency: bias_hz (1 - bias_chi detuning^2), the detuning in wavelengths",
     Real{at<&C::gyro, &Gyro::bias_chi>, non_negative}},
    {"gyro", "bias_edge_s", "s", "duration of a reversal of the bias field; below half a tick",
     Real{at<&C::gyro, &Gyro::bias_edge_s>, non_negative}},
    {"gyro", "first_bias_sign", "", "sign of the bias in the first half of every tick",
     Sign{at<&C::gyro, &Gyro::first_bias_sign>}},
    {"gyro", "reference_temperature_c", "C", "temperature at which bias_hz holds",
     Real{at<&C::gyro, &Gyro::reference_temperature_c>, any_finite}},
    {"gyro", "temperature_rise_c", "C", "warming of the gyro in operation, approached with drift.thermal_time_s",
     Real{at<&C::gyro, &Gyro::temperature_rise_c>, any_finite}},
    {"gyro", "bias_temperature_coefficient_per_c", "1/C", "relative change of the bias frequency with temperature",
     Real{at<&C::gyro, &Gyro::bias_temperature_coefficient_per_c>, any_finite}},
    {"gyro", "light_samples", "", "samples of the light in a half", Integer{at<&C::gyro, &Gyro::light_samples>, 1, 64}},
    {"gyro", "light_noise_lambda", "lambda", "noise of one light sample, white, as detuning",
     Real{at<&C::gyro, &Gyro::light_noise_lambda>, non_negative}},
    {"gyro", "discriminator_per_lambda", "1/lambda", "(I1 - I2)/(I1 + I2) per wavelength of detuning",
     Real{at<&C::gyro, &Gyro::discriminator_per_lambda>, non_zero}},

    {"drift", "magnetic_arcsec_s", "arcsec/s", "drift that changes its sign with the mode, at the start",
     Real{at<&C::drift, &Drift::magnetic_arcsec_s>, any_finite}},
    {"drift", "magnetic_thermal_arcsec_s", "arcsec/s", "growth of the magnetic drift by warming",
     Real{at<&C::drift, &Drift::magnetic_thermal_arcsec_s>, any_finite}},
    {"drift", "thermal_time_s", "s", "time constant of the warming",
     Real{at<&C::drift, &Drift::thermal_time_s>, positive}},
    {"drift", "nonmagnetic_arcsec_s", "arcsec/s", "drift that is the same in both modes",
     Real{at<&C::drift, &Drift::nonmagnetic_arcsec_s>, any_finite}},
    {"drift", "random_walk_arcsec_sqrt_s", "arcsec/sqrt(s)", "random walk of the angle",
     Real{at<&C::drift, &Drift::random_walk_arcsec_sqrt_s>, non_negative}},

    {"perimeter", "loop", "", "control of the perimeter", choice<&C::perimeter, &Perimeter::loop>(loops)},
    {"perimeter", "tau_s", "s", "time constant of the loop", Real{at<&C::perimeter, &Perimeter::tau_s>, positive}},
    {"perimeter", "limit_lambda", "lambda", "detuning at which the error signal is limited",
     Real{at<&C::perimeter, &Perimeter::limit_lambda>, positive}},
    {"perimeter", "miss_lambda", "lambda",
     "detuning when the loop closes, all causes included; 0: what comes of itself",
     Real{at<&C::perimeter, &Perimeter::miss_lambda>, {.min = 0.0, .max = 0.24, .without_max = true}}},
    {"perimeter", "expansion_lambda_per_c", "lambda/C", "growth of the perimeter with temperature",
     Real{at<&C::perimeter, &Perimeter::expansion_lambda_per_c>, any_finite}},

    {"piezo", "half_wave_v", "V",
     "voltage that moves the perimeter by half a wavelength, at gyro.reference_temperature_c",
     Real{at<&C::piezo, &Piezo::half_wave_v>, positive}},
    {"piezo", "half_wave_temperature_coefficient_per_c", "1/C",
     "relative change of the half-wave voltage with temperature",
     Real{at<&C::piezo, &Piezo::half_wave_temperature_coefficient_per_c>, any_finite}},
    {"piezo", "half_wave_error", "", "relative error of the half-wave voltage that control presumes at first",
     Real{at<&C::piezo, &Piezo::half_wave_error>, {.min = -0.9, .max = 0.9}}},
    {"piezo", "rc_s", "s", "time constant of the high-voltage stage", Real{at<&C::piezo, &Piezo::rc_s>, positive}},
    {"piezo", "slew_v_s", "V/s", "fastest change of the high voltage", Real{at<&C::piezo, &Piezo::slew_v_s>, positive}},
    {"piezo", "range_min_v", "V", "lower end of the high voltage",
     Real{at<&C::piezo, &Piezo::range_min_v>, any_finite}},
    {"piezo", "range_max_v", "V", "upper end of the high voltage; above the lower",
     Real{at<&C::piezo, &Piezo::range_max_v>, any_finite}},
    {"piezo", "dac_bits", "", "resolution of the set-point", Integer{at<&C::piezo, &Piezo::dac_bits>, 1, 24}},
    {"piezo", "adc_bits", "", "resolution of the voltage that is read back",
     Integer{at<&C::piezo, &Piezo::adc_bits>, 1, 24}},
    {"piezo", "adc_noise_v", "V", "noise of the voltage that is read back",
     Real{at<&C::piezo, &Piezo::adc_noise_v>, non_negative}},

    {"switching", "interval_s", "s", "from one opening of the loop to the next; at least gap_ticks + 2 ticks",
     Interval{positive}},
    {"switching", "first_segment", "", "length of the first segment: an interval or half of one",
     choice<&C::switching, &Switching::first_segment>(first_segments)},
    {"switching", "gap_ticks", "", "ticks for which the loop stays open at a switch",
     Integer{at<&C::switching, &Switching::gap_ticks>, 1, 16}},

    {"compensation", "relock", "",
     "correction of the false drift after closing; unset: mean_square where the log has detuning, none where not",
     optional_choice<&C::compensation, &Compensation::relock>(relocks)},
    {"compensation", "relock_ticks", "", "ticks after closing that are corrected",
     Integer{at<&C::compensation, &Compensation::relock_ticks>, 0, 1000000}},
    {"compensation", "bridge", "", "what replaces the ticks of a gap",
     choice<&C::compensation, &Compensation::bridge>(bridges)},
    {"compensation", "extrapolation_points", "", "measured ticks before a gap from which it is extrapolated",
     Integer{at<&C::compensation, &Compensation::extrapolation_points>, 1, 8}},
    {"compensation", "points_before", "", "measured ticks before a gap from which it is interpolated",
     Integer{at<&C::compensation, &Compensation::points_before>, 1, 8}},
    {"compensation", "points_after", "", "measured ticks after a gap from which it is interpolated",
     Integer{at<&C::compensation, &Compensation::points_after>, 1, 8}},

    {"motion", "kind", "", "how the gyro is turned", choice<&C::motion, &Motion::kind>(motions)},
    {"motion", "rate_arcsec_s", "arcsec/s", "constant rate; added to sine and sum",
     Real{at<&C::motion, &Motion::rate_arcsec_s>, any_finite}},
    {"motion", "amplitude_arcsec_s", "arcsec/s", "amplitudes of the rate; one for sine, one or more for sum",
     RealList{at<&C::motion, &Motion::amplitude_arcsec_s>, any_finite}},
    {"motion", "frequency_hz", "Hz", "frequencies, as many as amplitudes",
     RealList{at<&C::motion, &Motion::frequency_hz>, non_negative}},
    {"motion", "phase_deg", "deg", "phases at the start, as many as amplitudes",
     RealList{at<&C::motion, &Motion::phase_deg>, any_finite}},
    {"motion", "path", "", "the motion file, for kind file", Text{at<&C::motion, &Motion::path>}},
    {"motion", "column", "", "column of the file, the first is 1",
     Integer{at<&C::motion, &Motion::column>, 1, int32_max}},
    {"motion", "column_holds", "", "whether the column holds angle increments or rates",
     choice<&C::motion, &Motion::column_holds>(column_holds)},
    {"motion", "scale_arcsec", "arcsec", "angle (or rate in arcsec/s) per unit of the column",
     Real{at<&C::motion, &Motion::scale_arcsec>, non_zero}},
    {"motion", "rate_hz", "Hz", "rows of the file per second", Real{at<&C::motion, &Motion::rate_hz>, positive}},
    {"motion", "comment", "", "lines of the file that begin with this are skipped",
     Text{at<&C::motion, &Motion::comment>}},
    {"motion", "skip_lines", "", "lines of numbers to skip at the head of the file",
     Integer{at<&C::motion, &Motion::skip_lines>, 0, int32_max}},

    {"design", "switch_error_arcsec", "arcsec", "error of the angle that one switch leaves",
     Real{at<&C::design, &Design::switch_error_arcsec>, non_negative}},
    {"design", "run_lengths_s", "s", "lengths of run for which the design is worked out",
     RealList{at<&C::design, &Design::run_lengths_s>, positive}},
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
