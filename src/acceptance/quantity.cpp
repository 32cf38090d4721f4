#include <zlg/acceptance/quantity.hpp>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include <zlg/text/escape.hpp>
#include <zlg/text/spelling.hpp>

namespace zlg::acceptance {
namespace {

using enum RunKind;

const std::vector<RunKind> still{at_rest, switching};
const std::vector<RunKind> tables{rate_table}, heated{temperature}, from_cold{warm_up}, in_field{magnetic};
const std::vector<RunKind> of_own_logs{at_rest, switching, temperature, warm_up};
constexpr std::string_view any_record = "a static run of at least 64 samples";
constexpr std::string_view own = "a raw log of a switched gyro";

// In the order of the report.
const std::array table{
    QuantityInfo{"bias.deg_h", "bias: mean rate at rest, less the Earth's where axis and latitude say it", "deg/h",
                 any_record, still},
    QuantityInfo{"bias_repeatability.deg_h", "standard deviation of the bias from run to run", "deg/h",
                 "two static records or more", still},
    QuantityInfo{"bias_instability.deg_h", "bias instability B, of which 0.664 B is the floor of the Allan deviation",
                 "deg/h", any_record, still},
    QuantityInfo{"angle_random_walk.deg_sqrt_h", "angle random walk N", "deg/sqrt(h)", any_record, still},
    QuantityInfo{"rate_random_walk.deg_h_sqrt_h", "rate random walk K", "deg/h/sqrt(h)", any_record, still},
    QuantityInfo{"ramp.deg_h_h", "ramp R: growth of the rate", "deg/h/h", any_record, still},
    QuantityInfo{"quantisation.arcsec", "quantisation Q: standard deviation of the error of one angle", "arcsec",
                 any_record, still},
    QuantityInfo{"scale_factor.ppm", "scale factor: output by the nominal scale over the rate of the table, less 1",
                 "ppm", "a rate table of three stages or more", tables},
    QuantityInfo{"scale_nonlinearity.ppm",
                 "standard deviation of the stages about the straight line, of the largest output", "ppm",
                 "a rate table of three stages or more", tables},
    QuantityInfo{"scale_asymmetry.ppm", "scale factor of positive less that of negative rates", "ppm",
                 "a rate table with three stages of either sign, zero counting for both", tables},
    QuantityInfo{"scale_repeatability.ppm", "standard deviation of the scale factor from table to table", "ppm",
                 "two rate tables or more", tables},
    QuantityInfo{"threshold.deg_h", "smallest rate at which half of it or more shows", "deg/h",
                 "a rate table with stages of small rates", tables},
    QuantityInfo{"bias_temperature.deg_h_c", "change of the bias with temperature", "deg/h/C",
                 "a temperature run with temperature_c", heated},
    QuantityInfo{"bias_hysteresis.deg_h", "bias while warming less that while cooling at one temperature, magnitude",
                 "deg/h", "a temperature run that warms and cools", heated},
    QuantityInfo{"warm_up.s", "time from the start until the bias stays within [accept] warm_up_band_deg_h of its end",
                 "s", "a run from cold, long enough that it has settled, and the band", from_cold},
    QuantityInfo{"magnetic_sensitivity.deg_h_mt", "change of the bias with the field", "deg/h/mT",
                 "magnetic runs at two values of field_mt or more", in_field},
    QuantityInfo{"magnetic_residual.deg_h", "standard deviation of the bias about the straight line over the field",
                 "deg/h", "magnetic runs at three values of field_mt or more", in_field},
    QuantityInfo{"magnetic_drift.deg_h", "magnetic drift at the start of a log", "deg/h", own, of_own_logs},
    QuantityInfo{"magnetic_thermal.deg_h", "growth of the magnetic drift by warming", "deg/h", own, of_own_logs},
    QuantityInfo{"thermal_time.s", "time of that growth", "s", own, of_own_logs},
    QuantityInfo{"bias_frequency.hz", "bias frequency at the reference temperature", "Hz", "a raw log", of_own_logs},
    QuantityInfo{"bias_frequency_temperature.per_c", "its relative change with temperature", "1/C",
                 "raw logs over a range of temperature_c", of_own_logs},
    QuantityInfo{"chi.per_lambda2", "loss of bias with the square of the detuning", "1/lambda^2",
                 "a raw log with detuning_sq_lambda2 and re-locks", of_own_logs},
    QuantityInfo{"half_wave.v", "half-wave voltage of the piezo", "V", "a raw log with piezo_v and switches",
                 of_own_logs},
    QuantityInfo{"relock.s", "time from the closing of the loop until the detuning stays within 0.02 wavelengths", "s",
                 "a raw log with detuning_lambda and switches", still},
    QuantityInfo{"gap.ticks", "longest gap of a switch", "ticks", own, still},
    QuantityInfo{"miss.lambda", "miss: detuning in the first half after a switch, mean magnitude", "wavelengths",
                 "a raw log with detuning_lambda and switches", still},
    QuantityInfo{"switch_sigma.arcsec", "error of a switch as the compensation states it, rms", "arcsec", own, still},
    QuantityInfo{
        "switch_error.arcsec", "error of a switch at rest, where the rotation is known, rms", "arcsec", own, {at_rest}},
    QuantityInfo{"switches_withheld.count", "switches that were due and not made", "",
                 "a raw log that says switching.interval_s", still},
    QuantityInfo{"alarms.per_h", "stretches without a trusted reading that belong to no switch", "1/h", "a raw log",
                 still},
};

std::string_view stem(std::string_view name) { return name.substr(0, name.find('.')); }

}  // namespace

std::span<const QuantityInfo> quantities() { return table; }

const QuantityInfo* find_quantity(std::string_view name) {
    const auto found = std::ranges::find(table, name, &QuantityInfo::name);
    return found == table.end() ? nullptr : &*found;
}

bool is_magnitude(std::string_view name) {
    constexpr std::array<std::string_view, 9> with_sign{"bias.deg_h",
                                                        "ramp.deg_h_h",
                                                        "scale_factor.ppm",
                                                        "scale_asymmetry.ppm",
                                                        "bias_temperature.deg_h_c",
                                                        "magnetic_sensitivity.deg_h_mt",
                                                        "magnetic_drift.deg_h",
                                                        "magnetic_thermal.deg_h",
                                                        "bias_frequency_temperature.per_c"};
    return std::ranges::find(with_sign, name) == with_sign.end();
}

std::string unknown_quantity(std::string_view name) {
    const std::string shown = text::excerpt(name, 60, ' ');
    for (const QuantityInfo& q : table)
        if (stem(q.name) == stem(name))
            return fmt::format("'{}': {} is given in {}; allowed is {}", shown, stem(name), q.unit, q.name);
    const auto nearest =
        std::ranges::min_element(table, {}, [&](const QuantityInfo& q) { return text::letters_apart(shown, q.name); });
    return fmt::format("'{}' is no quantity; did you mean {}?", shown, nearest->name);
}

Value not_determined(std::string_view name, std::string reason) {
    Value value;
    value.name = name;
    value.reason = std::move(reason);
    return value;
}

Value measured(std::string_view name, double value, double uncertainty, double degrees, double hours) {
    return {.name = std::string{name},
            .determined = true,
            .value = value,
            .uncertainty = uncertainty,
            .degrees = degrees,
            .hours = hours};
}

Value counted(std::string_view name, double value, double hours) {
    Value v = measured(name, value, 0.0, std::numeric_limits<double>::infinity(), hours);
    v.law = Law::without_error;
    return v;
}

Value deviation(std::string_view name, double value, double degrees, double hours) {
    Value v = measured(name, value, value / std::sqrt(2.0 * degrees), degrees, hours);
    v.law = Law::chi;
    return v;
}

}  // namespace zlg::acceptance
