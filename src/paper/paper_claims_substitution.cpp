// The claims about the substitution of the gap.

#include <cmath>
#include <numbers>

#include <zlg/config/config.hpp>
#include <zlg/design/relock_tables.hpp>
#include <zlg/design/taylor.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/compensated_run.hpp>
#include <zlg/study/resolved.hpp>

#include "paper_claims_parts.hpp"

namespace zlg::paper {
namespace {

using design::Fit;

using design::table_tick_s;
constexpr double amplitude_arcsec_s = paper_oscillation.amplitude_arcsec_s;
constexpr double oscillation_hz = paper_oscillation.frequency_hz;

constexpr double slow_arcsec_s = 5.0;

double highest_hz(int order) {
    return design::highest_frequency_hz({Fit::interpolation, order, paper_gap_ticks}, amplitude_arcsec_s,
                                        paper_switch_error_arcsec);
}

// What a laser reads that turns slowly, in one mode and without any drift but that of lock-in.
double read_arcsec_s(double tick_s, core::DitherMethod dither) {
    constexpr double run_s = 40.0;
    config::Config c;
    c.gyro.fidelity = config::Fidelity::laser;
    c.gyro.tick_s = tick_s;
    c.gyro.dither = dither;
    c.laser.beam_power_w = 0.0;               // it would add 0.1 arcsec/s by chance
    c.gyro.readout = config::Readout::phase;  // whole counts would say it to a count in the run
    c.drift.magnetic_arcsec_s = c.drift.magnetic_thermal_arcsec_s = c.drift.nonmagnetic_arcsec_s = 0.0;
    c.motion.kind = config::MotionKind::constant;
    c.motion.rate_arcsec_s = slow_arcsec_s;
    c = rig::without_switching(study::resolved(c).config);
    const auto ticks = static_cast<std::int64_t>(std::llround(run_s / tick_s));
    return slow_arcsec_s + study::compensated_run(c, ticks, ticks).angle_error_arcsec() / run_s;
}

Finding claim_of_tick() {
    Finding finding{"before eq (14)", {slow_arcsec_s, config::Laser{}.lock_in_left_hz}};
    for (const auto dither : {core::DitherMethod::none, core::DitherMethod::automatic})
        for (const double tick_s : {0.01, 0.005, 0.002, 0.001})
            finding.values.emplace_back(read_arcsec_s(tick_s, dither));
    return finding;
}

std::vector<Finding> claims_before_the_fit() {
    const config::Config gyro;
    const double slew_v_s = gyro.piezo.slew_v_s;
    const double half_wave_v = gyro.piezo.half_wave_v;
    const double lsb = gyro.gyro.scale_arcsec;
    return {
        {"before eq (14)",
         {1e-3 * slew_v_s, 1e3 * half_wave_v / slew_v_s, half_wave_v, gyro.switching.gap_ticks,
          1e3 * table_tick_s * static_cast<double>(gyro.switching.gap_ticks)}},
        {"before eq (14)",
         {amplitude_arcsec_s, paper_switch_error_arcsec, highest_hz(2), 1.0 / (table_tick_s * highest_hz(2)),
          highest_hz(0)}},
        claim_of_tick(),
        {"before eq (14)", {lsb, design::counter_tick_sigma_arcsec(lsb)}},
    };
}

// False angles of the ticks after a gap that a correction leaves.
std::vector<double> left_arcsec(const design::TickDrifts& computed) {
    std::vector<double> left;
    for (const double rate : design::summarise(design::measured_arcsec_s, computed).residual_arcsec_s)
        left.push_back(table_tick_s * rate);
    return left;
}

// What they do to the sum through a constant and through a parabola.
std::string through_fits(const design::TickDrifts& computed) {
    const auto of_order = [&](int order) {
        return std::abs(
            design::relock_through_fit_arcsec({Fit::interpolation, order, paper_gap_ticks}, left_arcsec(computed)));
    };
    return fmt::format("{:.1f} and {:.1f} arcsec", of_order(0), of_order(2));
}

std::vector<Finding> claims_of_procedure() {
    const double motion = worst_arcsec(Fit::interpolation, 2);
    const double noise = paper_noise_arcsec * noise_gain(Fit::interpolation, 2);
    const double relock = std::abs(design::relock_residual_arcsec({}, left_arcsec(design::table2_computed_arcsec_s)));
    return {
        {"eqs (14), (16) to (18)",
         {worst_arcsec(Fit::extrapolation, 0), worst_arcsec(Fit::extrapolation, 1), worst_arcsec(Fit::extrapolation, 2),
          motion}},
        {"eq (15)", {}},
        {"eq (15)",
         {through_fits({}), through_fits(design::table1_computed_arcsec_s),
          through_fits(design::table2_computed_arcsec_s)}},
        {"eq (19)",
         {motion, noise, design::switch_error_as_printed_arcsec(motion, noise), relock,
          design::switch_error_arcsec(motion, noise, relock)}},
        {"after eq (19)", {worst_arcsec(Fit::interpolation, 1)}},
    };
}

std::vector<Finding> claims_of_series() {
    constexpr double x_s = 0.003;
    const double phase = 2.0 * std::numbers::pi * oscillation_hz * x_s;
    const double half_gap = std::numbers::pi * oscillation_hz * table_tick_s * paper_gap_ticks;
    return {
        {"eq (20), t = 0",
         {1e3 * x_s, amplitude_arcsec_s * std::sin(phase), design::series_at_zero(paper_oscillation, x_s).sum(),
          design::series_at_zero_as_printed(paper_oscillation, x_s).sum()}},
        {"eq (20), extremum",
         {1e3 * x_s, amplitude_arcsec_s * std::cos(phase), design::series_at_extremum(paper_oscillation, x_s).sum()}},
        {"figures 7 to 10",
         {-amplitude_arcsec_s * std::sin(half_gap), amplitude_arcsec_s * std::sin(half_gap),
          amplitude_arcsec_s * (1.0 - std::cos(half_gap))}},
    };
}

// A gap whose middle is a zero crossing: its response is real, so that it has no error.
double error_at_zero_arcsec() {
    const auto response = design::ErrorResponse({Fit::interpolation, 2, paper_gap_ticks});
    return std::abs(response(oscillation_hz).imag()) * amplitude_arcsec_s;
}

std::vector<Finding> claims_of_figures_8_to_10() {
    const auto part = [](int n) { return design::figure_time_s(n, table_tick_s) * oscillation_hz; };
    const auto list = [](int order) {
        return fmt::format("{:.1f}, {:.1f} and {:.1f} arcsec", worst_arcsec(Fit::interpolation, order, 1),
                           worst_arcsec(Fit::interpolation, order, 2), worst_arcsec(Fit::interpolation, order, 3));
    };
    return {
        {"figures 8 to 10",
         {worst_arcsec(Fit::interpolation, 0), worst_arcsec(Fit::interpolation, 2), error_at_zero_arcsec()}},
        {"figures 8 to 10",
         {oscillation_hz, paper_gap_ticks * table_tick_s * oscillation_hz, part(1), part(2), part(3)}},
        {"figures 9 and 10", {paper_switch_error_arcsec, list(0), list(2)}},
    };
}

std::vector<Finding> claims_of_noise() {
    const auto ratio = [](Fit fit, int order, int n) { return design::sigma_ratio_to_constant({fit, order, n}); };
    return {
        {"figure 11",
         {design::constant_noise_arcsec(paper_noise_arcsec, paper_gap_ticks),
          design::constant_noise_as_printed_arcsec(paper_noise_arcsec, paper_gap_ticks)}},
        {"figure 11",
         {ratio(Fit::interpolation, 1, 1), ratio(Fit::interpolation, 1, 3), ratio(Fit::interpolation, 2, 1),
          ratio(Fit::interpolation, 2, 3), ratio(Fit::extrapolation, 1, 1), ratio(Fit::extrapolation, 1, 3),
          ratio(Fit::extrapolation, 2, 1), ratio(Fit::extrapolation, 2, 3)}},
        {"after figure 11", {}},
    };
}

}  // namespace

std::vector<Finding> claims_of_substitution() {
    return joined(
        {claims_before_the_fit, claims_of_procedure, claims_of_series, claims_of_figures_8_to_10, claims_of_noise});
}

}  // namespace zlg::paper
