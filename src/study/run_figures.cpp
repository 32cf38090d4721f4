#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>
#include <zlg/study/run_page.hpp>

#include "run_view.hpp"

namespace zlg::study {
namespace {

using namespace report;

constexpr int drawn_points = 600;  // about as many as a figure has pixels
constexpr double visible_arcsec = 0.1;
constexpr const char* angle_error = "final minus true angle, arcsec";

Series thinned(const VariantResult& v, std::string name) { return thin(curve_of(v, std::move(name)), drawn_points); }

// Where the shown ticks begin, and the time of a half after that in ms.
struct Clock {
    explicit Clock(const RunResult& result)
        : half_ms{500.0 * result.tick_s}, first{result.magnified.empty() ? 0 : result.magnified.front().tick} {}

    [[nodiscard]] double ms(std::int64_t tick, double halves) const {
        return (2.0 * static_cast<double>(tick - first) + halves) * half_ms;
    }

    double half_ms;
    std::int64_t first;
};

report::Band gap_band(const RunResult& result) {
    const Clock clock{result};
    report::Band band{.x0 = 0.0, .x1 = 0.0, .name = "gap"};
    bool found = false;
    for (const MagnifiedTick& t : result.magnified) {
        if (t.measured) continue;
        if (!found) band.x0 = clock.ms(t.tick, 0.0);
        band.x1 = clock.ms(t.tick, 2.0);
        found = true;
    }
    return band;
}

}  // namespace

Series curve_of(const VariantResult& v, std::string name) {
    return {.name = std::move(name), .x = v.curve.t_s, .y = v.curve.error_arcsec};
}

Figure sawtooth_figure(const config::Config& config, const RunResult& result) {
    std::string caption = "In one mode the magnetic drift adds up without end.";
    if (result.switches.empty())
        caption +=
            " There was no switch, so that is what the gyro did; the curves differ by nothing but the compensation.";
    else if (config.compensation.magnetic == core::MagneticMethod::estimate)
        caption += " Of the gyro that switches the compensation subtracts it.";
    else
        caption += fmt::format(
            " Switched every {} s, its sign follows the helicity of the mode: the error is a sawtooth as high as "
            "interval \u00D7 magnetic drift, on a slow slope that is the non-magnetic drift of {} deg/h.",
            short_number(config.switching.interval_s), short_number(config.drift.nonmagnetic_arcsec_s));
    if (!faults_of(config).empty()) caption += " Shaded: the faults.";
    Figure f = blank_figure("angle-error", "Angle error against time", std::move(caption), "time, s", angle_error);
    if (const auto* v = result.variant("one_mode")) f.series.push_back(thinned(*v, "never switched"));
    if (const auto* v = result.variant("configured"))
        f.series.push_back(
            thinned(*v, result.switches.empty() ? "as configured" : "switched, compensated as configured"));
    const config::Faults& faults = config.faults;
    for (std::size_t i = 0; i < std::min(faults.at_s.size(), faults.duration_s.size()); ++i)
        f.bands.push_back(
            {faults.at_s[i], faults.at_s[i] + faults.duration_s[i], std::string{twin::facts(faults.kind[i]).name}});
    return f;
}

Figure sum_figure(const RunResult& result) {
    Figure f =
        blank_figure("sum-of-errors", "What the switches leave in the angle",
                     "The errors of the switches, summed: the angle error without the drift between them. The same "
                     "records, compensated in different ways.",
                     "time, s", "sum of the errors of the switches, arcsec");
    for (const char* name : {"relock_frequency", "bridge_constant", "relock_mean_square", "configured"}) {
        const VariantResult* v = result.variant(name);
        if (!v) continue;
        Series s = blank_series(name, Mark::steps);
        double sum = 0.0;
        add_point(s, 0.0, 0.0);
        for (const SwitchError& e : v->switches)
            if (!e.unrepaired)
                add_point(s, static_cast<double>(e.window.first_tick) * result.tick_s, sum += e.error_arcsec);
        add_point(s, duration_s(result), sum);
        f.series.push_back(std::move(s));
    }
    return f;
}

Figure magnified_figure(const RunResult& result) {
    const bool is_repaired = result.variants.back().unrepaired < static_cast<std::int64_t>(result.switches.size());
    Figure f = blank_figure(
        "one-switch", "One switch, tick by tick",
        fmt::format(
            "Each point is the angle of one tick. In the gap the counter reads nonsense, which is not drawn; {} After "
            "the gap the reading is still wrong while the perimeter settles: the final value is corrected for it.",
            is_repaired
                ? "the gyro delivers an extrapolation in real time and an interpolation as soon as the other side is "
                  "known. One tick then carries the difference, so that no angle is lost."
                : "this gap is not repaired, and the output says so."),
        "time, ms", "angle of the tick, arcsec");
    const Clock clock{result};
    Series read = blank_series("as read, where that differs", Mark::points);
    Series delivered = blank_series("delivered in real time", Mark::line, true);
    Series final_value = blank_series("final", Mark::points);
    Series truth = blank_series("true");
    for (const MagnifiedTick& t : result.magnified) {
        const double x = clock.ms(t.tick, 1.0);
        if (t.measured && std::abs(t.read_arcsec - t.final_arcsec) > visible_arcsec) add_point(read, x, t.read_arcsec);
        add_point(delivered, x, t.dtheta_arcsec);
        add_point(final_value, x, t.final_arcsec);
        add_point(truth, x, t.true_arcsec);
    }
    f.series = {std::move(truth), std::move(delivered), std::move(final_value), std::move(read)};
    f.bands.push_back(gap_band(result));
    return f;
}

Figure detuning_figure(const RunResult& result) {
    Figure f = blank_figure(
        "detuning", "Detuning of the perimeter through the switch",
        "While the loop is open the perimeter travels half a wavelength, from the middle of one mode to that "
        "of the other. Closed again, the loop removes what is left; the bias, and with it the reading, is "
        "false by the square of the detuning until then.",
        "time, ms", "detuning, wavelengths");
    const Clock clock{result};
    Series truth = blank_series("true, at the end of each half");
    Series seen = blank_series("measured, mean of each half", Mark::points);
    for (const MagnifiedTick& t : result.magnified) {
        for (unsigned h = 0; h < 2; ++h) {
            add_point(truth, clock.ms(t.tick, h + 1.0), t.true_detuning_lambda[h]);
            add_point(seen, clock.ms(t.tick, h + 0.5), t.measured ? t.detuning_lambda[h] : std::nan(""));
        }
    }
    f.series = {std::move(truth), std::move(seen)};
    f.bands.push_back(gap_band(result));
    return f;
}

Figure switch_error_figure(const RunResult& result) {
    Figure f = blank_figure(
        "errors-in-time", "Error of each switch, as configured",
        "Final minus true angle of every switch. The bars are the standard deviation that the compensation "
        "itself claims for it: rounding, light noise, random walk and the motion in the gap.",
        "time, s", "error of a switch, arcsec");
    Series errors = blank_series("error, with the claimed standard deviation", Mark::points);
    for (const SwitchLine& line : result.switches) {
        if (!std::isfinite(line.true_error_arcsec)) continue;
        add_point(errors, static_cast<double>(line.tick) * result.tick_s, line.true_error_arcsec);
        errors.y_error.push_back(line.sigma_arcsec);
    }
    f.series = {std::move(errors)};
    return f;
}

}  // namespace zlg::study
