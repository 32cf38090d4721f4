#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <zlg/report/number_text.hpp>

#include "run_view.hpp"

namespace zlg::study {
namespace {

using report::short_number;

// "1 switch", "40 switches"
std::string switches(std::size_t n) { return fmt::format("{} {}", n, n == 1 ? "switch" : "switches"); }

const VariantResult& configured(const RunResult& result) { return result.variants.back(); }

// Of an angle whose switches, if there were any, are said already.
std::string end_of(const RunResult& result) {
    return fmt::format("the angle is false by {} arcsec after {} s",
                       short_number(configured(result).angle_error_arcsec), short_number(duration_s(result)));
}

std::string without_switch(const config::Config& config, const RunResult& result) {
    if (const std::int64_t due = result.tally.due(); due > 0)
        return fmt::format("None of {} succeeded: {}", switches(static_cast<std::size_t>(due)), end_of(result));
    const bool is_due = config.switching.interval_s < duration_s(result);
    const std::string why = config.switching.schedule == config::Schedule::fixed && !is_due
                                ? fmt::format(", for the interval is {} s", short_number(config.switching.interval_s))
                                : "";
    return fmt::format("No switch in this run of {} s{}: there is nothing to correct, and {}",
                       short_number(duration_s(result)), why, end_of(result));
}

std::string with_switches(const RunResult& result) {
    const VariantResult& best = configured(result);
    const VariantResult* as_read = result.variant("switching");
    std::string text = switches(result.switches.size());
    if (best.unrepaired > 0) text += fmt::format(", {} with a gap that no bridge repairs", best.unrepaired);
    if (result.tally.failed > 0) text += fmt::format(", {} more failed", result.tally.failed);
    if (result.tally.withheld > 0) text += fmt::format(", {} more were due and withheld", result.tally.withheld);
    if (!best.switch_error) return text + "; none can be judged: " + end_of(result);
    text += fmt::format("; a switch costs {} arcsec rms as configured", short_number(best.switch_error->rms_arcsec));
    if (as_read != nullptr && as_read->switch_error)
        text += fmt::format(", {} without correction", short_number(as_read->switch_error->rms_arcsec));
    return text;
}

}  // namespace

double duration_s(const RunResult& result) { return static_cast<double>(result.ticks) * result.tick_s; }

std::vector<std::string> faults_of(const config::Config& config) {
    constexpr std::size_t most = 4;
    const config::Faults& f = config.faults;
    std::vector<std::string> out;
    for (std::size_t i = 0; i < std::min(f.kind.size(), most); ++i)
        out.push_back(
            fmt::format("{} at {:g} s for {:g} s", twin::facts(f.kind[i]).name, f.at_s.at(i), f.duration_s.at(i)));
    if (f.kind.size() > most) out.push_back(fmt::format("{} more", f.kind.size() - most));
    if (f.random_per_hour > 0.0)
        out.push_back(fmt::format("faults at random, {} an hour", short_number(f.random_per_hour)));
    return out;
}

std::string run_verdict(const config::Config& config, const RunResult& result) {
    const std::vector<std::string> faults = faults_of(config);
    std::string text = result.switches.empty() ? without_switch(config, result) : with_switches(result);
    if (!faults.empty()) {
        const bool says_end = text.ends_with(end_of(result));
        text = fmt::format("With a fault ({}): {}{}", fmt::join(faults, ", "), text,
                           says_end ? "" : "; " + end_of(result));
    }
    return text + ".";
}

}  // namespace zlg::study
