#include <zlg/study/what_happened.hpp>

#include <cmath>

#include <fmt/format.h>

#include <zlg/core/health.hpp>
#include <zlg/rig/switch_count.hpp>
#include <zlg/twin/fault_kinds.hpp>

#include "run_view.hpp"

namespace zlg::study {
namespace {

// A mean of fewer errors says little.
constexpr std::size_t few_switches = 10;

std::string number_of(std::size_t n, std::string_view what) {
    return n == 0 ? fmt::format("no {}", what) : fmt::format("{} {}{}", n, what, n == 1 ? "" : "es");
}

std::string length_and_switches(const config::Config& config, const RunResult& result) {
    const std::size_t n = result.switches.size();
    std::string text = fmt::format("{} s, {}", duration_s(result), number_of(n, "switch"));
    const bool is_fixed = config.switching.schedule == config::Schedule::fixed;
    if (n == 0 && result.tally.due() == 0 && is_fixed && duration_s(result) <= config.switching.interval_s)
        text += fmt::format(": the run is shorter than switching.interval_s = {:g}, so there is no error of a switch",
                            config.switching.interval_s);
    else if (n > 0 && n < few_switches)
        text += ": too few for more than a first impression of their errors";
    return text;
}

// `fringe_lost` is in the sentence of the whole counts.
std::string raised_bits(std::uint32_t bits) {
    std::vector<const char*> names;
    for (std::size_t bit = 0; bit < core::health_bit_names.size(); ++bit)
        if ((bits & ~core::health_fringe_lost & (1u << bit)) != 0) names.push_back(core::health_bit_names[bit]);
    return fmt::format("{}", fmt::join(names, ", "));
}

std::string what_the_core_saw(const config::Config& config, const RunResult& result) {
    const std::vector<std::string> faults = faults_of(config);
    const std::string raised = raised_bits(result.health_raised);
    if (faults.empty() && raised.empty() && result.invalid_ticks == 0) return {};
    const std::string invalid =
        fmt::format("{} of {} ticks outside the switches are invalid and were bridged or flagged", result.invalid_ticks,
                    result.ticks);
    return fmt::format("{}the core raised {}; {}",
                       faults.empty() ? "" : fmt::format("faults: {}; ", fmt::join(faults, ", ")),
                       raised.empty() ? "no health bit of trouble" : raised,
                       result.invalid_ticks > 0 ? invalid : "no tick outside the switches is invalid");
}

std::string unrepaired(const RunResult& result) {
    const std::int64_t n = result.variants.back().unrepaired;
    if (n == 0) return {};
    return fmt::format(
        "{} of {} switches have a gap that no bridge repairs (flag unrepaired): their errors are not in the table", n,
        result.switches.size());
}

std::string whole_counts(const RunResult& result) {
    if (result.whole_count_ticks == 0) return {};
    return fmt::format(
        "{} of {} ticks were read as whole counts: the ellipse of the photodiodes was not learnt yet, or not good "
        "enough ({} of them with fringe_lost in health.csv)",
        result.whole_count_ticks, result.ticks, result.fringe_lost_ticks);
}

}  // namespace

std::vector<std::string> what_happened(const config::Config& config, const RunResult& result) {
    std::vector<std::string> sentences{length_and_switches(config, result)};
    for (std::string sentence :
         {rig::sentence(result.tally), what_the_core_saw(config, result), unrepaired(result), whole_counts(result)})
        if (!sentence.empty()) sentences.push_back(std::move(sentence));
    return sentences;
}

RandomWalkShare random_walk_share(const config::Config& config, const RunResult& result) {
    if (config.gyro.fidelity == twin::Fidelity::laser) return {};
    const double walk_arcsec_sqrt_s = config.drift.random_walk_arcsec_sqrt_s;
    return {.drift_arcsec_s = walk_arcsec_sqrt_s * std::sqrt(1.2 / duration_s(result)),
            .angle_arcsec = walk_arcsec_sqrt_s * std::sqrt(duration_s(result))};
}

}  // namespace zlg::study
