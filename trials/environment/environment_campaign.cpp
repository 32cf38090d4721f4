#include <zlg/trials/environment_campaign.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>

#include <fmt/format.h>

#include <zlg/chance/draw.hpp>
#include <zlg/numeric/parallel.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/compensated_run.hpp>
#include <zlg/trials/gyro_campaign.hpp>
#include <zlg/trials/table_head.hpp>

namespace zlg::trials {
namespace {

using twin::CoursePoint;
using twin::FieldKind;

constexpr double max_harm = 1.1;
constexpr double min_mean_sq = 0.5, max_mean_sq = 1.5;

std::string draw_profile(const chance::Draws& draws, double run_s, config::Config& c) {
    constexpr double ramp_c_s = 10.0 / 3600.0;
    constexpr std::array names{"ramp up", "ramp down", "soak", "chamber", "own warming"};
    const auto kind = draws.of("profile").below(names.size());
    const double start_c = draws.of("start").within(-40.0, 60.0);
    const auto at = [&](double time_s, double change_c) {
        c.temperature.profile.points.push_back({time_s, start_c + change_c});
    };
    if (kind <= 1) {
        at(0.0, 0.0);
        at(run_s, (kind == 0 ? 1.0 : -1.0) * ramp_c_s * run_s);
    } else if (kind == 2) {
        at(0.0, 0.0);
        at(0.25 * run_s, draws.of("step").within(-10.0, 10.0));
        at(run_s, c.temperature.profile.points.back().value - start_c);
    } else if (kind == 3) {
        const double swing_c = draws.of("swing").within(2.0, 10.0);
        for (int k = 0; k <= 8; ++k) at(run_s * k / 8.0, k % 4 == 0 ? 0.0 : k % 4 == 2 ? swing_c : 0.5 * swing_c);
    }
    c.temperature.sensor_lag_s = draws.of("lag").is_one_in(2) ? 0.0 : draws.of("lag_s").within(1.0, 60.0);
    c.temperature.sensor_error_c = draws.of("error_c").within(-1.0, 1.0);
    return names[kind];
}

// Of the gyro's own drift, in whose place a field makes another one.
void forget_calibration(config::Compensation& c) {
    const config::Compensation unknown;
    c.magnetic_arcsec_s = unknown.magnetic_arcsec_s;
    c.magnetic_sigma_arcsec_s = unknown.magnetic_sigma_arcsec_s;
    c.magnetic_thermal_arcsec_s = unknown.magnetic_thermal_arcsec_s;
    c.magnetic_thermal_sigma_arcsec_s = unknown.magnetic_thermal_sigma_arcsec_s;
    c.magnetic_thermal_time_s = unknown.magnetic_thermal_time_s;
}

std::string draw_field(const chance::Draws& draws, double run_s, config::Config& c) {
    constexpr std::array names{"drift", "constant", "sine", "steps"};
    const auto kind = draws.of("field").below(names.size());
    c.field.kind = static_cast<FieldKind>(kind);
    if (c.field.kind != FieldKind::none) forget_calibration(c.compensation);
    c.field.sensitivity_arcsec_s_g = draws.of("sensitivity").within(0.1, 5.0);
    c.field.sensitivity_per_c = draws.of("sensitivity_per_c").within(-0.02, 0.0);
    c.field.field_g = draws.of("field_g").within(-0.6, 0.6);
    c.field.frequency_hz = draws.of("frequency_hz").within(1e-4, 1e-2);
    if (c.field.kind == FieldKind::steps)
        for (int k = 0; k < 6; ++k)
            c.field.course.points.push_back({run_s * k / 6.0, draws.of(fmt::format("step {}", k)).within(-0.6, 0.6)});
    return names[kind];
}

double second_half_rms(const study::ErrorMeter& meter, double nonmagnetic_arcsec_s) {
    const study::Curve& curve = meter.curve();
    double sum_sq = 0.0, n = 0.0;
    for (std::size_t k = curve.t_s.size() / 2; k < curve.t_s.size(); ++k, ++n) {
        const double error = curve.error_arcsec[k] - nonmagnetic_arcsec_s * curve.t_s[k];
        sum_sq += error * error;
    }
    return std::sqrt(sum_sq / n);
}

// Both methods on the same records.
void compare_methods(const config::Config& config, EnvironmentOutcome& out) {
    const twin::Motion motion = rig::motion(config);
    const std::int64_t ticks = rig::run_ticks(config, motion);
    rig::ClosedLoop loop{config, motion};
    std::vector<study::MeteredCompensation> methods;
    for (const auto method : {core::MagneticMethod::none, core::MagneticMethod::estimate}) {
        config::Config c = config;
        c.compensation.magnetic = method;
        methods.emplace_back(c, std::max<std::int64_t>(1, ticks / 2000));
    }
    for (std::int64_t half = 0; half < 2 * ticks; ++half) {
        const rig::LoopHalf now = loop.advance();
        for (study::MeteredCompensation& method : methods) method.take(now, loop.light());
    }
    out.none_arcsec = second_half_rms(methods[0].end(), config.drift.nonmagnetic_arcsec_s);
    out.estimate_arcsec = second_half_rms(methods[1].end(), config.drift.nonmagnetic_arcsec_s);
}

EnvironmentOutcome outcome(const EnvironmentGyro& gyro, std::uint64_t number) {
    EnvironmentOutcome out{.family = gyro.family};
    const GyroOutcome alone = run(GyroTrial{.number = number, .config = gyro.config});
    out.crash = alone.crash;
    out.lost = alone.lost || alone.not_finite;
    out.switches = alone.judged;
    out.sum_sq_ratio = alone.mean_sq_ratio * static_cast<double>(alone.judged);
    try {
        if (out.crash.empty()) compare_methods(gyro.config, out);
    } catch (const std::exception& error) {
        out.crash = error.what();
    }
    return out;
}

struct Family {
    std::int64_t gyros = 0, lost = 0, switches = 0;
    double sum_sq_ratio = 0.0, worst_harm = 0.0;
    std::vector<double> gains;

    void add(const EnvironmentOutcome& o) {
        ++gyros;
        lost += o.lost || !o.crash.empty();
        switches += o.switches;
        sum_sq_ratio += o.sum_sq_ratio;
        if (!(o.none_arcsec > 0.0)) return;
        gains.push_back(o.estimate_arcsec / o.none_arcsec);
        worst_harm = std::max(worst_harm, gains.back());
    }
    [[nodiscard]] double mean_sq() const { return sum_sq_ratio / static_cast<double>(switches); }
    [[nodiscard]] double median() {
        if (gains.empty()) return 0.0;
        std::ranges::nth_element(gains, gains.begin() + static_cast<std::ptrdiff_t>(gains.size() / 2));
        return gains[gains.size() / 2];
    }
};

}  // namespace

EnvironmentGyro environment_gyro(const EnvironmentCampaign& campaign, std::uint64_t number) {
    const chance::Draws draws{.seed = campaign.seed, .cause = chance::Cause::environment, .trial = number};
    config::Config c = random_gyro(campaign.seed, number, config::Fidelity::averaged).config;
    c.run.duration_s = campaign.run_s;
    c.switching.schedule = config::Schedule::fixed;
    c.switching.interval_s = draws.of("interval_s").within(20.0, 90.0);
    const std::string profile = draw_profile(draws, campaign.run_s, c);
    return {fmt::format("{}, {}", profile, draw_field(draws, campaign.run_s, c)), c};
}

std::vector<EnvironmentOutcome> run(const EnvironmentCampaign& campaign) {
    std::vector<EnvironmentOutcome> outcomes(campaign.gyros);
    numeric::in_parallel(outcomes.size(), campaign.threads,
                         [&](std::size_t k) { outcomes[k] = outcome(environment_gyro(campaign, k), k); });
    return outcomes;
}

std::vector<std::string> complaints(const std::vector<EnvironmentOutcome>& outcomes) {
    std::vector<std::string> found;
    Family all;
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
        const EnvironmentOutcome& o = outcomes[k];
        all.add(o);
        if (!o.crash.empty()) found.push_back(fmt::format("gyro {}: {}: {}", k, o.family, o.crash));
        if (o.lost) found.push_back(fmt::format("gyro {}: {}: lost", k, o.family));
        if (o.estimate_arcsec > max_harm * o.none_arcsec)
            found.push_back(fmt::format("gyro {}: {}: {:.2f} arcsec estimated, {:.2f} without", k, o.family,
                                        o.estimate_arcsec, o.none_arcsec));
    }
    if (!(all.mean_sq() >= min_mean_sq && all.mean_sq() <= max_mean_sq))
        found.push_back(fmt::format("mean square of error over sigma {:.2f}, allowed is {} to {}", all.mean_sq(),
                                    min_mean_sq, max_mean_sq));
    return found;
}

std::string markdown(const std::vector<EnvironmentOutcome>& outcomes) {
    std::map<std::string, Family> families;
    for (const EnvironmentOutcome& o : outcomes) {
        families[o.family.substr(0, o.family.find(','))].add(o);
        families["field: " + o.family.substr(o.family.find(',') + 2)].add(o);
        families["~ all"].add(o);
    }
    std::string text = table_head({"family", "gyros", "lost", "switches", "mean square of error over sigma",
                                   "angle estimated over not, median", "worst"});
    for (auto& [name, family] : families)
        text += fmt::format("| {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", name, family.gyros, family.lost,
                            family.switches, family.mean_sq(), family.median(), family.worst_harm);
    return text;
}

}  // namespace zlg::trials
