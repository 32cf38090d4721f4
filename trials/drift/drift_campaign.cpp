#include <zlg/trials/drift_campaign.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <zlg/chance/draw.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/numeric/parallel.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/compensated_run.hpp>

namespace zlg::trials {
namespace {

constexpr int samples_before = 20;

// Excess of the drift of one method at one of the times, and the sum of its squares over moments before; with the walk
// of the gyro and without.
struct Residual {
    double end_arcsec_s = 0.0;
    double sum_sq_before = 0.0;
    double end_less_walk_arcsec_s = 0.0;
    double sum_sq_before_less_walk = 0.0;
};

struct RunOfMethod {
    std::vector<Residual> at;
    double switches = 0.0;
    std::vector<study::SwitchError> errors;
};

using RunOfGyro = std::vector<RunOfMethod>;

std::vector<study::MeteredCompensation> compensations(const DriftGyro& gyro, std::int64_t stride) {
    std::vector<study::MeteredCompensation> all;
    for (const DriftMethod& method : gyro.methods) {
        config::Config config = gyro.config;
        config.compensation = method.compensation;
        all.emplace_back(config, stride);
    }
    return all;
}

config::Config drawn(const DriftGyro& gyro, std::uint64_t seed, double run_s) {
    config::Config config = gyro.config;
    config.compensation = gyro.methods.front().compensation;
    config.run.seed = seed;
    config.run.duration_s = run_s;
    chance::Draw draw{seed, chance::Cause::drift_motion};
    for (double& phase : config.motion.phase_deg) phase = 360.0 * draw.uniform();
    return config;
}

// The times at which to look, in ticks: for each time the moments before it, and itself.
struct Moment {
    std::int64_t tick = 0;
    std::size_t time = 0;
};

std::vector<Moment> moments(const DriftCampaign& campaign, double tick_s) {
    std::vector<Moment> all;
    for (std::size_t i = 0; i < campaign.times_s.size(); ++i) {
        const double ticks = std::floor(campaign.times_s[i] / tick_s + 1e-6);
        for (int k = samples_before - 1; k >= 0; --k)
            all.push_back({std::llround(ticks * (1.0 - 0.05 * k / samples_before)), i});
    }
    std::ranges::stable_sort(all, {}, &Moment::tick);
    return all;
}

RunOfGyro run_one(const DriftCampaign& campaign, const DriftGyro& gyro, std::uint64_t seed) {
    const config::Config config = drawn(gyro, seed, campaign.times_s.back());
    rig::ClosedLoop loop{config, rig::motion(config)};
    const std::vector<Moment> looks = moments(campaign, config.gyro.tick_s);
    std::vector<study::MeteredCompensation> compensated = compensations(gyro, looks.back().tick);
    RunOfGyro result(compensated.size(), RunOfMethod{std::vector<Residual>(campaign.times_s.size()), 0.0, {}});
    core::ExactSum truth, walk;
    std::int64_t tick = 0, switches = 0;
    for (const Moment& moment : looks) {
        for (; tick < moment.tick; ++tick) {
            for (int half = 0; half < 2; ++half) {
                const rig::LoopHalf now = loop.advance();
                truth.add(now.truth.dtheta_arcsec);
                walk.add(now.truth.random_walk_arcsec);
                switches += now.control.has_event;
                for (study::MeteredCompensation& c : compensated) c.take(now, loop.light());
            }
        }
        const double t_s = static_cast<double>(tick) * config.gyro.tick_s;
        for (std::size_t m = 0; m < compensated.size(); ++m) {
            const double excess =
                (compensated[m].angle_arcsec() - truth.value()) / t_s - config.drift.nonmagnetic_arcsec_s;
            Residual& at = result[m].at[moment.time];
            const double less_walk = excess - walk.value() / t_s;
            at.sum_sq_before += excess * excess;
            at.sum_sq_before_less_walk += less_walk * less_walk;
            at.end_arcsec_s = excess;  // the last moment of a time is its end
            at.end_less_walk_arcsec_s = less_walk;
        }
    }
    for (std::size_t m = 0; m < result.size(); ++m) {
        result[m].switches = static_cast<double>(switches);
        result[m].errors = compensated[m].end().switches();
    }
    return result;
}

DriftAtTime statistics(double time_s, const std::vector<Residual>& residuals) {
    DriftAtTime at{.time_s = time_s};
    std::vector<double> sizes;
    const auto n = static_cast<double>(residuals.size());
    for (const Residual& r : residuals) {
        at.rms_arcsec_s += r.end_arcsec_s * r.end_arcsec_s / n;
        at.mean_arcsec_s += r.end_arcsec_s / n;
        at.rms_before_arcsec_s += r.sum_sq_before / (n * samples_before);
        at.rms_less_walk_arcsec_s += r.end_less_walk_arcsec_s * r.end_less_walk_arcsec_s / n;
        at.rms_before_less_walk_arcsec_s += r.sum_sq_before_less_walk / (n * samples_before);
        sizes.push_back(std::abs(r.end_arcsec_s));
    }
    for (double* rms :
         {&at.rms_arcsec_s, &at.rms_before_arcsec_s, &at.rms_less_walk_arcsec_s, &at.rms_before_less_walk_arcsec_s})
        *rms = std::sqrt(*rms);
    std::ranges::sort(sizes);
    at.max_arcsec_s = sizes.back();
    at.percentile_95_arcsec_s = sizes[static_cast<std::size_t>(std::ceil(0.95 * n)) - 1];
    return at;
}

// The runs of one gyro stand together, one for each seed.
std::vector<DriftFigures> figures_of(const DriftCampaign& campaign, const std::vector<RunOfGyro>& runs) {
    std::vector<DriftFigures> figures;
    const auto seeds = static_cast<std::size_t>(campaign.seeds);
    for (std::size_t g = 0; g < campaign.gyros.size(); ++g) {
        const DriftGyro& gyro = campaign.gyros[g];
        for (std::size_t m = 0; m < gyro.methods.size(); ++m) {
            DriftFigures f{.gyro = gyro.name, .method = gyro.methods[m].name};
            std::vector<study::SwitchError> errors;
            for (std::size_t s = 0; s < seeds; ++s) {
                const RunOfMethod& run = runs[g * seeds + s][m];
                f.switches += run.switches / static_cast<double>(seeds);
                errors.insert(errors.end(), run.errors.begin(), run.errors.end());
            }
            if (const auto all = study::statistics(errors)) {
                f.switch_mean_arcsec = all->mean_arcsec;
                f.switch_rms_arcsec = all->rms_arcsec;
            }
            for (std::size_t i = 0; i < campaign.times_s.size(); ++i) {
                std::vector<Residual> residuals;
                for (std::size_t s = 0; s < seeds; ++s) residuals.push_back(runs[g * seeds + s][m].at[i]);
                f.at.push_back(statistics(campaign.times_s[i], residuals));
            }
            figures.push_back(std::move(f));
        }
    }
    return figures;
}

}  // namespace

std::vector<DriftGyro> over_tones(int n, std::uint64_t seed) {
    std::vector<DriftGyro> gyros;
    chance::Draw draw{seed, chance::Cause::drift_motion};
    DriftMethod alone{"joint, auto", {.relock = core::RelockMethod::joint, .magnetic = core::MagneticMethod::none}};
    DriftMethod magnetic{"joint, auto, magnetic", alone.compensation};
    magnetic.compensation.magnetic = core::MagneticMethod::estimate;
    for (int k = 0; k < n; ++k) {
        config::Config c;
        c.drift.magnetic_arcsec_s = c.drift.magnetic_thermal_arcsec_s = 0.0;
        const double hz = draw.within(10.0, 60.0),
                     amplitude = 1000.0 * core::maths::exp(core::maths::log(20.0) * draw.uniform());
        c.motion.frequency_hz = {hz};
        c.motion.amplitude_arcsec_s = {amplitude};
        c.switching.interval_s = draw.within(8.0, 20.0);
        gyros.push_back({fmt::format("{:.2f} Hz, {:.0f} arcsec/s, {:.2f} s", hz, amplitude, c.switching.interval_s),
                         c,
                         {alone, magnetic}});
    }
    return gyros;
}

std::vector<DriftFigures> run(const DriftCampaign& campaign) {
    const auto seeds = static_cast<std::size_t>(campaign.seeds);
    std::vector<RunOfGyro> runs(campaign.gyros.size() * seeds);
    numeric::in_parallel(runs.size(), campaign.threads, [&](std::size_t k) {
        runs[k] = run_one(campaign, campaign.gyros[k / seeds], campaign.seed + k % seeds);
    });
    return figures_of(campaign, runs);
}

std::string markdown(const std::vector<DriftFigures>& figures) {
    std::string text =
        "| gyro | compensation | switches | a switch, arcsec: mean | rms | t, s | rms | mean | 95 % | max | rms of the "
        "last 5 % of t | without the walk: rms | rms of the last 5 % |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const DriftFigures& f : figures) {
        for (const DriftAtTime& at : f.at)
            text += fmt::format(
                "| {} | {} | {:.0f} | {:+.4f} | {:.3f} | {:.0f} | {:.5f} | {:+.5f} | {:.5f} | {:.5f} | {:.5f} | {:.5f} "
                "| {:.5f} |\n",
                f.gyro, f.method, f.switches, f.switch_mean_arcsec, f.switch_rms_arcsec, at.time_s, at.rms_arcsec_s,
                at.mean_arcsec_s, at.percentile_95_arcsec_s, at.max_arcsec_s, at.rms_before_arcsec_s,
                at.rms_less_walk_arcsec_s, at.rms_before_less_walk_arcsec_s);
    }
    return text;
}

}  // namespace zlg::trials
