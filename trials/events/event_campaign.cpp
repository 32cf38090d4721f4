#include <zlg/trials/event_campaign.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include <fmt/format.h>

#include <zlg/chance/draw.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/core/common/maths.hpp>
#include <zlg/numeric/parallel.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/study/compensated_run.hpp>
#include <zlg/trials/table_head.hpp>

namespace zlg::trials {
namespace {

constexpr std::size_t n_numbers = event_numbers.size();

// What a run leaves.
struct RunOfGyro {
    std::vector<double> error_arcsec;  // of its switches, with the sign of the false angle
    double sigma_arcsec = 0.0;
    double drift_arcsec_s = 0.0;
    double end_arcsec = 0.0;
    double cpu_s = 0.0;
};

double cpu_s() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

RunOfGyro run_of(config::Config config, config::Fidelity fidelity, std::uint64_t seed) {
    config.gyro.fidelity = fidelity;
    config.run.seed = seed;
    chance::Draw draw{seed, chance::Cause::event_gyro};
    for (double& phase : config.motion.phase_deg) phase = 360.0 * draw.uniform();
    const double start_s = cpu_s();
    const auto ticks = static_cast<std::int64_t>(*config.run.duration_s / config.gyro.tick_s);
    rig::ClosedLoop loop{config, recorded::motion(config)};
    study::MeteredCompensation compensation{config, ticks};
    RunOfGyro made;
    double n_sigmas = 0.0;
    compensation.on_gap = [&](const core::GapReport& gap) {
        if (!gap.mode_changed || !std::isfinite(gap.sigma_sum_arcsec)) return;
        made.sigma_arcsec += gap.sigma_sum_arcsec;
        n_sigmas += 1.0;
    };
    compensation.follow(loop, ticks);
    const study::ErrorMeter& meter = compensation.end();
    for (const study::SwitchError& e : meter.switches())
        if (!e.unrepaired) made.error_arcsec.push_back(e.window.sign_after * e.error_arcsec);
    made.sigma_arcsec /= std::max(n_sigmas, 1.0);
    made.drift_arcsec_s = meter.drift_without_nonmagnetic_arcsec_s();
    made.end_arcsec = meter.angle_error_without_nonmagnetic_arcsec();
    made.cpu_s = cpu_s() - start_s;
    return made;
}

double mean_of(const std::vector<RunOfGyro>& runs, auto value) {
    double sum = 0.0;
    for (const RunOfGyro& run : runs) sum += value(run);
    return sum / static_cast<double>(runs.size());
}

// What both ways are measured by: of those that live.
struct Measure {
    std::array<double, 3> percentile{};
    double drift_arcsec_s = 0.0;
    double end_arcsec = 0.0;

    explicit Measure(const std::vector<RunOfGyro>& lived)
        : drift_arcsec_s{mean_of(lived, [](const RunOfGyro& r) { return r.drift_arcsec_s; })},
          end_arcsec{mean_of(lived, [](const RunOfGyro& r) { return r.end_arcsec; })} {
        std::vector<double> all;
        for (const RunOfGyro& r : lived) all.insert(all.end(), r.error_arcsec.begin(), r.error_arcsec.end());
        std::ranges::sort(all);
        if (all.empty()) return;
        const std::array parts{0.1, 0.5, 0.9};
        for (std::size_t i = 0; i < parts.size(); ++i)
            percentile[i] = all[static_cast<std::size_t>(parts[i] * static_cast<double>(all.size()))];
    }

    [[nodiscard]] std::array<double, n_numbers> of(const RunOfGyro& run) const {
        std::array<double, n_numbers> x{};
        const double n = std::max(static_cast<double>(run.error_arcsec.size()), 1.0);
        for (const double e : run.error_arcsec) {
            x[0] += e / n;
            x[1] += e * e / n;
            for (std::size_t i = 0; i < percentile.size(); ++i) x[2 + i] += (e < percentile[i]) / n;
        }
        x[5] = run.sigma_arcsec;
        x[6] = run.drift_arcsec_s;
        x[7] = std::pow(run.drift_arcsec_s - drift_arcsec_s, 2);
        x[8] = run.end_arcsec;
        x[9] = std::pow(run.end_arcsec - end_arcsec, 2);
        return x;
    }
};

// Student's t of d degrees of freedom as the normal deviate that is as rare (Wallace, 1959): to .02 from d = 3 on.
double normal_of(double t, double d) {
    const double size = std::sqrt(d * core::maths::log(1.0 + t * t / d)) * (8.0 * d + 1.0) / (8.0 * d + 3.0);
    return std::copysign(size, t);
}

// By Welch's test, whose degrees of freedom follow from the runs of either way; 0 where neither scatters.
std::array<double, n_numbers> compared(const std::vector<RunOfGyro>& lived, const std::vector<RunOfGyro>& leapt) {
    // The squares of either way are about its own mean.
    std::array measures{Measure{lived}, Measure{leapt}};
    measures[1].percentile = measures[0].percentile;
    std::array<double, n_numbers> z{};
    for (std::size_t i = 0; i < n_numbers; ++i) {
        std::array<double, 2> means{};
        double variance = 0.0, of_degrees = 0.0;
        for (std::size_t way = 0; way < 2; ++way) {
            const std::vector<RunOfGyro>& runs = way == 0 ? lived : leapt;
            const auto n = static_cast<double>(runs.size());
            const auto value = [&](const RunOfGyro& r) { return measures[way].of(r)[i]; };
            means[way] = mean_of(runs, value);
            const double own =
                mean_of(runs, [&](const RunOfGyro& r) { return std::pow(value(r) - means[way], 2); }) / (n - 1.0);
            variance += own;
            of_degrees += own * own / (n - 1.0);
        }
        if (variance > 0.0)
            z[i] = normal_of((means[1] - means[0]) / std::sqrt(variance), variance * variance / of_degrees);
    }
    return z;
}

}  // namespace

config::Config event_gyro(std::int64_t k, std::string* settings) {
    constexpr std::array intervals{"30", "2", "10", "90", "5", "300", "600"};
    constexpr std::array methods{"compensation.relock=joint compensation.bridge=auto",
                                 "compensation.relock=mean_square compensation.bridge=quadratic"};
    constexpr std::array loops{"analog", "digital", "exponential"};
    constexpr std::array motions{"motion.kind=rest", "motion.kind=constant motion.rate_arcsec_s=37.3",
                                 "motion.kind=sine motion.amplitude_arcsec_s=1000 motion.frequency_hz=0.7",
                                 "motion.kind=sum motion.rate_arcsec_s=5 motion.amplitude_arcsec_s=[400,12000] "
                                 "motion.frequency_hz=[1.3,20.06] motion.phase_deg=[0,90]"};
    constexpr std::array others{
        "", "compensation.magnetic=estimate", "gyro.bias_temperature_coefficient_per_c=2e-4 drift.thermal_time_s=200",
        "light.gain_b=1.3 light.offset_a=0.01 light.gain_drift_per_h=0.05", "gyro.readout=phase"};
    const auto at = [k](const auto& list) { return std::string{list[static_cast<std::size_t>(k) % list.size()]}; };
    std::string text = "switching.interval_s=" + at(intervals) + " perimeter.loop=" + at(loops) + " " + at(motions) +
                       " " + std::string{methods[static_cast<std::size_t>(k / 4) % methods.size()]} + " " + at(others);
    config::Config made;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find(' ', from), text.size());
        if (to > from) config::apply_set(made, text.substr(from, to - from));
        from = to + 1;
    }
    if (settings) *settings = text;
    return made;
}

std::vector<EventFigures> run(const EventCampaign& campaign) {
    std::vector<EventFigures> figures(static_cast<std::size_t>(campaign.gyros));
    numeric::in_parallel(figures.size(), campaign.threads, [&](std::size_t k) {
        EventFigures& made = figures[k];
        config::Config config = event_gyro(static_cast<std::int64_t>(k), &made.gyro);
        const double interval_s = config.switching.interval_s;
        config.run.duration_s =
            std::min((campaign.switches + 0.5) * interval_s, std::max(campaign.longest_s, 1.5 * interval_s));
        config::check(config);
        std::vector<RunOfGyro> lived, leapt;
        for (std::int64_t r = 0; r < campaign.runs; ++r) {
            const std::uint64_t seed = campaign.seed * 1'000'000 + 1000 * k + static_cast<std::uint64_t>(2 * r);
            lived.push_back(run_of(config, config::Fidelity::averaged, seed));
            leapt.push_back(run_of(config, config::Fidelity::events, seed + 1));
        }
        made.halves = 2.0 * static_cast<double>(campaign.runs) * *config.run.duration_s / config.gyro.tick_s;
        for (const RunOfGyro& r : lived) made.lived_s += r.cpu_s;
        for (const RunOfGyro& r : leapt) made.leapt_s += r.cpu_s;
        made.z = compared(lived, leapt);
    });
    return figures;
}

namespace {

double mean_square(const std::vector<EventFigures>& figures) {
    double sum = 0.0, n = 0.0;
    for (const EventFigures& f : figures)
        for (const double z : f.z) {
            sum += z * z;
            n += z != 0.0;
        }
    return n > 0.0 ? sum / n : 0.0;
}

}  // namespace

std::string markdown(const std::vector<EventFigures>& figures) {
    std::string text =
        table_head({"gyro", "half by half, ns a half", "closed-form steps, ns a half", "mean", "mean square",
                    "below p10", "below p50", "below p90", "sigma", "drift", "drift^2", "end", "end^2"});
    std::array<int, 9> histogram{};
    double halves = 0.0, lived_s = 0.0, leapt_s = 0.0;
    for (const EventFigures& f : figures) {
        text += fmt::format("| {} | {:.0f} | {:.1f} |", f.gyro, 1e9 * f.lived_s / f.halves, 1e9 * f.leapt_s / f.halves);
        for (const double z : f.z) {
            text += fmt::format(" {:.2f} |", z);
            ++histogram[static_cast<std::size_t>(std::clamp(std::floor(z + 4.5), 0.0, 8.0))];
        }
        text += '\n';
        halves += f.halves;
        lived_s += f.lived_s;
        leapt_s += f.leapt_s;
    }
    text += "\n" + table_head({"z", "found", "normal law"});
    const auto n = static_cast<double>(figures.size() * n_numbers);
    for (int bin = 0; bin < 9; ++bin) {
        // Shares of the normal law within half of 0, of 1, ..., and beyond 3.5.
        constexpr std::array shares{0.3829249, 0.2417303, 0.0605975, 0.0059770, 0.0002326};
        const double share = shares[static_cast<std::size_t>(std::abs(bin - 4))];
        text += fmt::format("| {} | {} | {:.1f} |\n", bin - 4, histogram[static_cast<std::size_t>(bin)], n * share);
    }
    return text + fmt::format("\nmean z^2 {:.3f}; {:.0f} ns a half half by half, {:.1f} with closed-form steps\n",
                              mean_square(figures), 1e9 * lived_s / halves, 1e9 * leapt_s / halves);
}

// Numbers of a gyro are not independent, three of ten count for one: the standard error of the mean of z^2 is doubled.
std::string complaint(const std::vector<EventFigures>& figures) {
    double largest = 0.0;
    std::string worst;
    for (const EventFigures& f : figures) {
        for (std::size_t i = 0; i < n_numbers; ++i) {
            if (std::abs(f.z[i]) <= largest) continue;
            largest = std::abs(f.z[i]);
            worst = fmt::format("{} of {}", event_numbers[i], f.gyro);
        }
    }
    const double n = static_cast<double>(figures.size() * n_numbers);
    const double square = mean_square(figures), most = 1.0 + 3.1 * 2.0 * std::sqrt(2.0 / n);
    if (square <= most && largest <= 5.0) return {};
    return fmt::format("mean z^2 {:.3f}, at most {:.3f}; largest z {:.2f}, at most 5: {}", square, most, largest,
                       worst);
}

}  // namespace zlg::trials
