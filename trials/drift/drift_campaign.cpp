#include <zlg/trials/drift_campaign.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <zlg/numeric/draw.hpp>
#include <zlg/numeric/parallel.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>

namespace zlg::trials {
namespace {

constexpr int samples_before = 20;

// Excess of the drift of one method at one of the times, and the sum of its squares over moments before.
struct Residual {
    double end_arcsec_s = 0.0;
    double sum_sq_before = 0.0;
};

struct RunOfMethod {
    std::vector<Residual> at;
    double switches = 0.0;
};

using RunOfGyro = std::vector<RunOfMethod>;

std::vector<rig::Replay> compensations(const DriftGyro& gyro) {
    std::vector<rig::Replay> all;
    for (const DriftMethod& method : gyro.methods) {
        config::Config config = gyro.config;
        config.compensation = method.compensation;
        all.emplace_back(rig::asked_compensation(config));
    }
    return all;
}

config::Config drawn(const DriftGyro& gyro, std::uint64_t seed, double run_s) {
    config::Config config = gyro.config;
    config.compensation = gyro.methods.front().compensation;
    config.run.seed = seed;
    config.run.duration_s = run_s;
    numeric::Draw draw{seed};
    for (double& phase : config.motion.phase_deg) phase = 360.0 * draw.uniform();
    return config;
}

// The times at which to look, in ticks: for each time the moments before it, and itself.
struct Moment {
    std::int64_t tick = 0;
    std::size_t time = 0;
    bool is_end = false;
};

std::vector<Moment> moments(const DriftCampaign& campaign, double tick_s) {
    std::vector<Moment> all;
    for (std::size_t i = 0; i < campaign.times_s.size(); ++i) {
        const double ticks = std::floor(campaign.times_s[i] / tick_s + 1e-6);
        for (int k = samples_before - 1; k >= 0; --k)
            all.push_back({std::llround(ticks * (1.0 - 0.05 * k / samples_before)), i, k == 0});
    }
    std::ranges::stable_sort(all, {}, &Moment::tick);
    return all;
}

RunOfGyro run_one(const DriftCampaign& campaign, const DriftGyro& gyro, std::uint64_t seed) {
    const config::Config config = drawn(gyro, seed, campaign.times_s.back());
    rig::ClosedLoop loop{config, rig::motion(config)};
    std::vector<rig::Replay> compensated = compensations(gyro);
    RunOfGyro result(compensated.size(), RunOfMethod{std::vector<Residual>(campaign.times_s.size()), 0.0});
    core::ExactSum truth;
    std::int64_t tick = 0, switches = 0;
    for (const Moment& moment : moments(campaign, config.gyro.tick_s)) {
        for (; tick < moment.tick; ++tick) {
            for (int half = 0; half < 2; ++half) {
                const rig::LoopHalf now = loop.advance();
                truth.add(now.truth.dtheta_arcsec);
                switches += now.control.has_event;
                for (rig::Replay& c : compensated) c.take(now.record, loop.light());
            }
        }
        const double t_s = static_cast<double>(tick) * config.gyro.tick_s;
        for (std::size_t m = 0; m < compensated.size(); ++m) {
            const double excess =
                (compensated[m].angle_arcsec() - truth.value()) / t_s - config.drift.nonmagnetic_arcsec_s;
            Residual& at = result[m].at[moment.time];
            at.sum_sq_before += excess * excess;
            if (moment.is_end) at.end_arcsec_s = excess;
        }
    }
    for (RunOfMethod& method : result) method.switches = static_cast<double>(switches);
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
        sizes.push_back(std::abs(r.end_arcsec_s));
    }
    at.rms_arcsec_s = std::sqrt(at.rms_arcsec_s);
    at.rms_before_arcsec_s = std::sqrt(at.rms_before_arcsec_s);
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
            for (std::size_t s = 0; s < seeds; ++s)
                f.switches += runs[g * seeds + s][m].switches / static_cast<double>(seeds);
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

std::vector<DriftFigures> run(const DriftCampaign& campaign) {
    const auto seeds = static_cast<std::size_t>(campaign.seeds);
    std::vector<RunOfGyro> runs(campaign.gyros.size() * seeds);
    numeric::in_parallel(runs.size(), campaign.threads, [&](std::size_t k) {
        runs[k] = run_one(campaign, campaign.gyros[k / seeds], campaign.first_seed + k % seeds);
    });
    return figures_of(campaign, runs);
}

std::string markdown(const std::vector<DriftFigures>& figures) {
    std::string text =
        "| gyro | compensation | switches | t, s | rms | mean | 95 % | max | rms of the last 5 % of t |\n"
        "|---|---|---|---|---|---|---|---|---|\n";
    for (const DriftFigures& f : figures) {
        for (const DriftAtTime& at : f.at)
            text += fmt::format("| {} | {} | {:.0f} | {:.0f} | {:.5f} | {:+.5f} | {:.5f} | {:.5f} | {:.5f} |\n", f.gyro,
                                f.method, f.switches, at.time_s, at.rms_arcsec_s, at.mean_arcsec_s,
                                at.percentile_95_arcsec_s, at.max_arcsec_s, at.rms_before_arcsec_s);
    }
    return text;
}

}  // namespace zlg::trials
