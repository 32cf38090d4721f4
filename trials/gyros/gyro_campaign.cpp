#include <zlg/trials/gyro_campaign.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include <zlg/numeric/parallel.hpp>
#include <zlg/trials/table_head.hpp>

namespace zlg::trials {
namespace {

constexpr std::int64_t min_switches = 5;  // from which on the rms of a gyro says something
constexpr std::size_t min_gyros = 50;     // and their median: its standard error is 0.05 then
constexpr double max_sigmas = 5.0;
// Of the squares of their rms. Sigma is wanted such that they are .25 to 1.4 in steady motion, .2 to 1.4 by phase, .4
// to 1.5 in the median of manoeuvres and .5 to 1.5 in changing surroundings; these gyros meet all of it, so of either
// limit the strictest holds.
constexpr double min_median = 0.5;
constexpr double max_median = 1.4;

const char* name_of(config::Fidelity fidelity) { return fidelity == config::Fidelity::laser ? "laser" : "averaged"; }

std::vector<double> rms_ratios(const std::vector<GyroOutcome>& outcomes) {
    std::vector<double> ratios;
    for (const GyroOutcome& o : outcomes)
        if (o.judged >= min_switches) ratios.push_back(std::sqrt(o.mean_sq_ratio));
    std::ranges::sort(ratios);
    return ratios;
}

// 0..1; NaN of nothing.
double quantile(const std::vector<double>& sorted, double part) {
    if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
    return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1) + 0.5)];
}

// What of this gyro breaks a limit; empty where nothing does.
std::string fault_of(const GyroOutcome& o) {
    if (!o.crash.empty()) return "crash: " + o.crash;
    std::string text;
    const auto add = [&](bool is_broken, const std::string& what) {
        if (is_broken) text += (text.empty() ? "" : "; ") + what;
    };
    add(o.lost, "lost");
    add(o.not_finite, "what is no number");
    add(o.unrepaired > 0, fmt::format("{} ticks unrepaired", o.unrepaired));
    add(!o.alarm_names().empty(), "false alarm: " + o.alarm_names());
    add(o.worst_sigmas > max_sigmas, fmt::format("a switch off by {:.1f} sigma", o.worst_sigmas));
    return text;
}

std::string row(const char* name, const std::vector<GyroOutcome>& gyros) {
    std::int64_t refused = 0, lost = 0, alarmed = 0, unrepaired = 0, switches = 0, flagged = 0, failed = 0, ticks = 0,
                 valid = 0, wrong = 0;
    double worst = 0.0, worst_flagged = 0.0;
    std::vector<double> rms_arcsec;
    for (const GyroOutcome& o : gyros) {
        refused += o.refused;
        lost += o.lost || !o.crash.empty();
        alarmed += !o.alarm_names().empty();
        unrepaired += o.unrepaired > 0;
        switches += o.judged;
        flagged += o.flagged;
        failed += o.failed;
        ticks += o.ticks;
        valid += o.valid;
        wrong += o.wrong_ticks;
        worst = std::max(worst, o.worst_sigmas);
        worst_flagged = std::max(worst_flagged, o.worst_flagged_sigmas);
        if (o.judged >= min_switches) rms_arcsec.push_back(o.switch_rms_arcsec);
    }
    std::ranges::sort(rms_arcsec);
    const std::vector<double> ratios = rms_ratios(gyros);
    const auto draws = static_cast<double>(refused) + static_cast<double>(gyros.size());
    return fmt::format(
        "| {} | {} | {:.1f} % | {} | {} | {} | {:.2f} % | {} | {}, {} | {} | {:.2f} | {:.2f}, {:.2f}, {:.2f} | "
        "{:.1f}, {:.1f} | {} |\n",
        name, gyros.size(), 100.0 * static_cast<double>(refused) / std::max(draws, 1.0), lost, alarmed, unrepaired,
        100.0 * static_cast<double>(valid) / static_cast<double>(std::max<std::int64_t>(ticks, 1)), switches, flagged,
        failed, ratios.size(), quantile(rms_arcsec, 0.5), quantile(ratios, 0.05), quantile(ratios, 0.5),
        quantile(ratios, 0.95), worst, worst_flagged, wrong);
}

}  // namespace

std::vector<GyroOutcome> run(const GyroCampaign& campaign) {
    std::vector<GyroOutcome> outcomes(campaign.gyros);
    numeric::in_parallel(outcomes.size(), campaign.threads, [&](std::size_t k) {
        const std::uint64_t number = campaign.first + k;
        outcomes[k] = run(random_gyro(campaign.seed, number, campaign.fidelities[number % campaign.fidelities.size()]));
    });
    return outcomes;
}

std::vector<std::string> complaints(const std::vector<GyroOutcome>& outcomes) {
    std::vector<std::string> found;
    for (const GyroOutcome& o : outcomes)
        if (const std::string fault = fault_of(o); !fault.empty())
            found.push_back(fmt::format("gyro {}: {}: {}", o.number, fault, o.command));
    const std::vector<double> ratios = rms_ratios(outcomes);
    const double median = quantile(ratios, 0.5) * quantile(ratios, 0.5);
    if (ratios.size() >= min_gyros && !(median >= min_median && median <= max_median))
        found.push_back(
            fmt::format("mean square of error over sigma: the median of {} gyros is {:.2f}, allowed is {} to {}",
                        ratios.size(), median, min_median, max_median));
    return found;
}

std::string summary_markdown(const std::vector<GyroOutcome>& outcomes) {
    std::string text =
        table_head({"fidelity", "gyros", "draws refused", "lost", "with false alarms", "with unrepaired ticks",
                    "ticks valid", "switches", "flagged, failed", "gyros with 5 switches",
                    "their rms error of a switch, arcsec: median", "rms of error over sigma: 5 %, median, 95 %",
                    "worst switch, sigma: without, with flag", "valid ticks beyond 5 sigma"});
    for (const config::Fidelity fidelity : {config::Fidelity::averaged, config::Fidelity::laser}) {
        std::vector<GyroOutcome> some;
        std::ranges::copy_if(outcomes, std::back_inserter(some),
                             [&](const GyroOutcome& o) { return o.fidelity == fidelity; });
        if (!some.empty()) text += row(name_of(fidelity), some);
    }
    return text + row("all", outcomes);
}

std::string gyros_markdown(const std::vector<GyroOutcome>& outcomes) {
    std::string text =
        table_head({"gyro", "fidelity", "refused", "ticks", "valid", "unrepaired", "switches", "flagged", "failed",
                    "rms error, arcsec", "rms of error over sigma", "worst, sigma: without, with flag", "wrong ticks",
                    "drift, arcsec/s", "lost", "false alarms", "command"});
    for (const GyroOutcome& o : outcomes)
        text += fmt::format(
            "| {} | {} | {} | {} | {:.2f} % | {} | {} | {} | {} | {:.3g} | {:.2f} | {:.1f}, {:.1f} | {} | {:.3g} | {} "
            "| {} | "
            "`{}` |\n",
            o.number, name_of(o.fidelity), o.refused, o.ticks,
            100.0 * static_cast<double>(o.valid) / static_cast<double>(std::max<std::int64_t>(o.ticks, 1)),
            o.unrepaired, o.judged, o.flagged, o.failed, o.switch_rms_arcsec, std::sqrt(o.mean_sq_ratio),
            o.worst_sigmas, o.worst_flagged_sigmas, o.wrong_ticks, o.drift_arcsec_s,
            o.lost || !o.crash.empty() ? "lost" : "", o.alarm_names(), o.command);
    return text;
}

}  // namespace zlg::trials
