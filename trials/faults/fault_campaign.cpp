#include <zlg/trials/fault_campaign.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <zlg/numeric/parallel.hpp>
#include <zlg/trials/table_head.hpp>

namespace zlg::trials {
namespace {

struct Job {
    std::optional<twin::FaultKind> kind;
    std::uint64_t seed = 0;
    bool many_at_once = false;
    std::size_t row = 0;  // of the table
};

// Trials of one kind are those of any campaign of that seed, however long.
std::vector<Job> jobs_of(const std::vector<std::optional<twin::FaultKind>>& kinds, const FaultCampaign& campaign) {
    const auto n_kinds = static_cast<std::int64_t>(kinds.size()) - 1;
    std::vector<Job> jobs;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        const auto place = static_cast<std::int64_t>(k) - 1;  // of a kind; "none" has as many as the first
        const std::int64_t n =
            campaign.faults / n_kinds + (std::max<std::int64_t>(0, place) < campaign.faults % n_kinds);
        const std::uint64_t kind_seed = kinds[k] ? static_cast<std::uint64_t>(*kinds[k]) + 1 : 0;
        for (std::int64_t i = 0; i < n; ++i) {
            const std::uint64_t seed = (campaign.seed << 40) + (kind_seed << 32) + static_cast<std::uint64_t>(i);
            jobs.push_back({.kind = kinds[k], .seed = seed, .row = k});
        }
    }
    for (std::int64_t i = 0; i < campaign.faults / n_kinds; ++i) {
        const auto first = static_cast<std::size_t>(i % n_kinds) + 1;
        const std::uint64_t seed = (campaign.seed << 40) + (std::uint64_t{255} << 32) + static_cast<std::uint64_t>(i);
        jobs.push_back({.kind = kinds[first], .seed = seed, .many_at_once = true, .row = kinds.size()});
    }
    return jobs;
}

std::vector<FaultOutcome> outcomes_of(const std::vector<Job>& jobs, const FaultCampaign& campaign) {
    std::vector<FaultOutcome> outcomes(jobs.size());
    numeric::in_parallel(jobs.size(), campaign.threads, [&](std::size_t k) {
        outcomes[k] = run(
            random_trial(jobs[k].kind, jobs[k].seed, campaign.fidelity, jobs[k].many_at_once, campaign.surroundings));
    });
    return outcomes;
}

double ratio(std::int64_t part, std::int64_t whole) {
    return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 1.0;
}

// Sums of one kind that the figures are made of.
struct Sums {
    std::int64_t outside = 0, valid_outside = 0, after = 0, valid_after = 0;
    double angle_sq = 0.0;
    double error_sq = 0.0;
    std::vector<double> latency_s;
};

void add_angle(const FaultOutcome& o, FaultFigures& f, Sums& sums) {
    if (!std::isfinite(o.angle_sigma_arcsec)) return;
    ++f.claimed;
    const double error = std::abs(o.angle_error_arcsec);
    if (error <= 5.0 * o.angle_sigma_arcsec) {
        sums.angle_sq += error * error;
    } else {
        ++f.angle_beyond_5;
    }
}

void add(const FaultOutcome& o, FaultFigures& f, Sums& sums) {
    ++f.faults;
    if (!o.crash.empty()) {
        ++f.crashed;
        return;
    }
    f.detected += o.detected;
    if (o.detected) sums.latency_s.push_back(o.latency_s);
    f.ticks += o.ticks;
    sums.outside += o.ticks_outside;
    sums.valid_outside += o.valid_outside;
    sums.after += o.ticks_after;
    sums.valid_after += o.valid_after;
    sums.error_sq += o.error_sq_sum;
    f.with_wrong_ticks += o.wrong > 0;
    f.wrong_ticks += o.wrong;
    f.wrong_bridged += o.wrong_bridged;
    f.worst_sigmas = std::max(f.worst_sigmas, o.worst_sigmas);
    f.recovered += o.recovered;
    f.not_finite += o.not_finite;
    add_angle(o, f, sums);
}

void conclude(Sums& sums, FaultFigures& f) {
    f.valid_outside_ratio = ratio(sums.valid_outside, sums.outside);
    f.valid_after_ratio = ratio(sums.valid_after, sums.after);
    if (sums.valid_outside > 0) f.mean_sq_ratio = sums.error_sq / static_cast<double>(sums.valid_outside);
    const std::int64_t held = f.claimed - f.angle_beyond_5;
    if (held > 0) f.angle_rms_arcsec = std::sqrt(sums.angle_sq / static_cast<double>(held));
    if (sums.latency_s.empty()) return;
    std::ranges::sort(sums.latency_s);
    f.median_latency_s = sums.latency_s[sums.latency_s.size() / 2];
    f.longest_latency_s = sums.latency_s.back();
}

}  // namespace

std::vector<FaultFigures> run(const FaultCampaign& campaign) {
    std::vector<std::optional<twin::FaultKind>> kinds{std::nullopt};
    if (campaign.kinds.empty()) {
        for (const twin::FaultKind kind : twin::all_fault_kinds) kinds.emplace_back(kind);
    }
    for (const twin::FaultKind kind : campaign.kinds) kinds.emplace_back(kind);
    const std::vector<Job> jobs = jobs_of(kinds, campaign);
    const std::vector<FaultOutcome> outcomes = outcomes_of(jobs, campaign);
    std::vector<std::string> names;
    for (const auto& kind : kinds) names.emplace_back(kind ? twin::facts(*kind).name : "none");
    const bool on_bench = campaign.surroundings == Surroundings::bench;
    names.insert(names.end(), {on_bench ? "two to six" : "two at once", "all"});
    std::vector<FaultFigures> figures(names.size());
    std::vector<Sums> sums(names.size());
    for (std::size_t k = 0; k < jobs.size(); ++k) {
        add(outcomes[k], figures[jobs[k].row], sums[jobs[k].row]);
        if (jobs[k].kind) add(outcomes[k], figures.back(), sums.back());
    }
    for (std::size_t row = 0; row < names.size(); ++row) {
        figures[row].kind = names[row];
        conclude(sums[row], figures[row]);
    }
    return figures;
}

std::vector<std::string> complaints(const std::vector<FaultFigures>& figures) {
    constexpr double min_valid = 0.995;
    constexpr double min_mean_sq = 0.5;
    constexpr double max_mean_sq = 1.5;
    std::vector<std::string> found;
    for (const FaultFigures& f : figures) {
        if (f.recovered != f.faults)
            found.push_back(fmt::format("{}: {} of {} recovered, allowed is all", f.kind, f.recovered, f.faults));
        if (f.not_finite + f.crashed > 0)
            found.push_back(
                fmt::format("{}: {} with NaN, {} crashed, allowed is none", f.kind, f.not_finite, f.crashed));
        const bool is_sum = f.kind == "all";
        if (!is_sum && f.kind != "none" && !f.kind.starts_with("two")) continue;
        if (f.faults > 0 && !(f.valid_outside_ratio >= min_valid))
            found.push_back(fmt::format("{}: {:.2f} % of the ticks outside valid, allowed is {:.1f} and more", f.kind,
                                        100.0 * f.valid_outside_ratio, 100.0 * min_valid));
        if (is_sum && !(f.mean_sq_ratio >= min_mean_sq && f.mean_sq_ratio <= max_mean_sq))
            found.push_back(fmt::format("{}: mean square of error over sigma {:.2f}, allowed is {} to {}", f.kind,
                                        f.mean_sq_ratio, min_mean_sq, max_mean_sq));
    }
    return found;
}

std::string markdown(const std::vector<FaultFigures>& figures) {
    std::string text = table_head({"fault", "number", "detected", "after, ms: median, longest", "valid outside",
                                   "valid after", "mean square of error over sigma", "wrong ticks: valid, bridged",
                                   "valid ones of a million ticks", "faults with them", "angle claimed",
                                   "beyond 5 sigma", "rms of the others, arcsec", "recovered", "NaN", "crash"});
    for (const FaultFigures& f : figures) {
        const std::string detected =
            f.kind == "none" ? "" : fmt::format("{:.1f} %", 100.0 * ratio(f.detected, f.faults));
        const std::string latency =
            f.detected > 0 ? fmt::format("{:.1f}, {:.0f}", 1e3 * f.median_latency_s, 1e3 * f.longest_latency_s) : "";
        text += fmt::format(
            "| {} | {} | {} | {} | {:.2f} % | {:.2f} % | {:.2f} | {}, {} | {:.2f} | {} | {} | {} | {:.1f} | {:.1f} % | "
            "{} | {} "
            "|\n",
            f.kind, f.faults, detected, latency, 100.0 * f.valid_outside_ratio, 100.0 * f.valid_after_ratio,
            f.mean_sq_ratio, f.wrong_ticks, f.wrong_bridged, 1e6 * ratio(f.wrong_ticks, f.ticks), f.with_wrong_ticks,
            f.claimed, f.angle_beyond_5, f.angle_rms_arcsec, 100.0 * ratio(f.recovered, f.faults), f.not_finite,
            f.crashed);
    }
    return text;
}

}  // namespace zlg::trials
