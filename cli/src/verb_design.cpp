#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/study/design_study.hpp>

#include "as_json.hpp"
#include "failure.hpp"
#include "fields_json.hpp"
#include "options.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace zlg::cli {
namespace {

using nlohmann::json;

struct DesignOptions : Options {
    std::optional<std::string> run_lengths;
};

json interval_json(const study::IntervalLine& l) {
    json j = fields_json(l.optimum);
    j["run_s"] = l.run_s;
    j["method"] = design::name(l.method);
    j["status"] = design::sentence(l.optimum.status);
    j["rise_at_0_7_arcsec_s"] = l.sensitivity.shorter_arcsec_s;
    j["rise_at_1_3_arcsec_s"] = l.sensitivity.longer_arcsec_s ? json(*l.sensitivity.longer_arcsec_s) : json(nullptr);
    return j;
}

json roots_json(const design::Roots& roots) {
    return {{"status", design::sentence(roots.status)},
            {"interval_s", roots.status == design::RootStatus::found ? json(roots.smaller_s) : json(nullptr)}};
}

json run_json(const study::RunLine& r) {
    json j = fields_json(r.terms);
    j["run_s"] = r.run_s;
    j["best"] = fields_json(r.best);
    j["corrected_9"] = roots_json(r.corrected_roots);
    j["printed_9"] = roots_json(r.roots_as_printed);
    j["half_first_segment"] = fields_json(r.half_first_segment);
    return j;
}

json loop_json(const study::LoopLine& l) {
    json j =
        fields_json(l, {{"stability_limit", "tick_over_tau_limit"}, {"stability_note", "tick_over_tau_limit_for"}});
    j.update(fields_json(l.margins));
    j.update(fields_json(
        l.miss, {{"root_sum_square_lambda", "miss_root_sum_square_lambda"}, {"worst_lambda", "miss_worst_lambda"}}));
    for (const design::MissPart& part : l.miss.part) j["miss_lambda"][std::string{part.name}] = part.lambda;
    return j;
}

json result_json(const study::DesignResult& result) {
    json j{{"switch_error_arcsec", result.switch_error_arcsec},
           {"switch_error_is_given", result.switch_error_is_given},
           {"optimum", json::array()},
           {"runs", json::array()},
           {"substitution", fields_json(result.substitution)},
           {"loop", loop_json(result.loop)}};
    for (const auto& l : result.intervals) j["optimum"].push_back(interval_json(l));
    for (const auto& r : result.runs) j["runs"].push_back(run_json(r));
    return j;
}

std::string interval_text(const study::DesignResult& result) {
    std::string text = fmt::format("best interval between switches\n{:>10}  {:<12}{:>12}{:>14}{:>12}{:>12}\n", "run, s",
                                   "method", "interval, s", "drift, \"/s", "+ at 0.7 L", "+ at 1.3 L");
    for (const auto& l : result.intervals) {
        const std::string longer =
            l.sensitivity.longer_arcsec_s ? fmt::format("{:.4f}", *l.sensitivity.longer_arcsec_s) : "-";
        text += fmt::format("{:>10.6g}  {:<12}{:>12.1f}{:>14.4f}{:>12.4f}{:>12}", l.run_s, design::name(l.method),
                            l.optimum.interval_s, l.optimum.drift_arcsec_s, l.sensitivity.shorter_arcsec_s, longer);
        if (l.optimum.status != design::OptimumStatus::inside)
            text += fmt::format("  {}", design::sentence(l.optimum.status));
        text += '\n';
    }
    return text;
}

std::string best_text(const study::DesignResult& result) {
    std::string text = fmt::format(
        "\na switch leaves {:.3g} arcsec rms, {}; what that makes best, as switching.interval_s = \"optimal\"\n"
        "{:>10}{:>14}{:>14}\n",
        result.switch_error_arcsec, result.switch_error_source, "run, s", "interval, s", "drift, \"/s");
    for (const auto& r : result.runs)
        text += fmt::format("{:>10.6g}{:>14.1f}{:>14.4f}\n", r.run_s, r.best.interval_s, r.best.drift_arcsec_s);
    return text;
}

std::string substitution_text(const study::DesignResult& result) {
    std::string text = fmt::format(
        "\nerror of the gap's angle after eq (15), arcsec\n{:>8}{:>6}{:>7}{:>10}{:>10}{:>12}{:>11}{:>10}{:>11}\n", "Hz",
        "gap", "order", "worst", "rms", "noise gain", "rounding", "re-lock", "together");
    for (const auto& l : result.substitution) {
        const std::string hz = std::isfinite(l.frequency_hz) ? fmt::format("{:.4g}", l.frequency_hz) : "all";
        text += fmt::format("{:>8}{:>6}{:>7}{:>10.3f}{:>10.3f}{:>12.3f}{:>11.3f}{:>10.3f}{:>11.3f}\n", hz, l.gap_ticks,
                            l.order, l.worst_arcsec, l.rms_arcsec, l.noise_gain, l.counter_arcsec, l.relock_arcsec,
                            l.total_arcsec);
    }
    return text;
}

std::string run_length_text(const study::DesignResult& result) {
    std::string text = fmt::format(
        "\nthe corrected budget at its best interval, and another policy, arcsec/s\n{:>10}{:>10}{:>10}{:>10}"
        "{:>10}   half first segment\n",
        "run, s", "non-mag.", "quasi", "sawtooth", "switches");
    for (const auto& r : result.runs)
        text += fmt::format("{:>10.6g}{:>10.4f}{:>10.4f}{:>10.4f}{:>10.4f}   {:.4f} at {:.4g} s\n", r.run_s,
                            r.terms.nonmagnetic_arcsec_s, r.terms.quasi_nonmagnetic_arcsec_s, r.terms.sawtooth_arcsec_s,
                            r.terms.switch_errors_arcsec_s, r.half_first_segment.drift_arcsec_s,
                            r.half_first_segment.interval_s);
    return text;
}

std::string loop_text(const study::LoopLine& l) {
    std::string text =
        fmt::format("\nperimeter loop, {}\n  phase margin {:.1f} deg, gain margin {:.3g}\n",
                    l.margins.stable ? "stable" : "UNSTABLE", l.margins.phase_margin_deg, l.margins.gain_margin);
    text += fmt::format("  T/tau {:.2f}; stable below {:.2f} for {}\n", l.tick_over_tau, l.stability_limit,
                        l.stability_note);
    const std::string time = std::isfinite(l.relock_s)
                                 ? fmt::format("{:.1f} ms (linear {:.1f} ms), false angle {:.1f} arcsec",
                                               1e3 * l.relock_s, 1e3 * l.relock_linear_s, l.false_angle_arcsec)
                                 : l.relock_note;
    text += fmt::format("  re-lock from {:.4g} to 0.01 wavelength: {}; (T/4) G(0+) {:.1f} arcsec\n",
                        l.relock_from_lambda, time, l.false_angle_law_arcsec);
    return text + fmt::format("  miss: root sum square {:.4f}, worst {:.4f} wavelength\n",
                              l.miss.root_sum_square_lambda, l.miss.worst_lambda);
}

void design_gyro(const DesignOptions& options) {
    config::Config config = load_config(options);
    if (options.run_lengths) {
        // Only what a list of numbers is made of: nothing else may reach the configuration by this way.
        if (options.run_lengths->find_first_not_of("0123456789.,eE+- ") != std::string::npos)
            throw UsageError{fmt::format("--run-lengths {}: allowed are numbers of seconds, separated by commas",
                                         *options.run_lengths)};
        config::apply_pair(config, "design.run_lengths_s", "[" + *options.run_lengths + "]", "--run-lengths");
        config::check(config);
    }
    // The interval is what is asked for here.
    config.switching.interval_optimal = false;
    config = resolve(config).config;
    const study::DesignResult result = study::design_gyro(config);
    if (!options.out.empty()) {
        require_suffix(options.out, ".html");
        write_file(options.out, report::html(study::design_page(config, result)), options.force);
    }
    print(options.json ? pretty(result_json(result))
                       : interval_text(result) + best_text(result) + run_length_text(result) +
                             substitution_text(result) + loop_text(result.loop));
}

}  // namespace

void add_design(CLI::App& program) {
    const auto options = std::make_shared<DesignOptions>();
    CLI::App* verb = program.add_subcommand("design", "drift budget, best interval, substitution errors, loop margins");
    add_config_argument(*verb, *options);
    verb->add_option("--run-lengths", options->run_lengths, "lengths of run, with commas between");
    add_output_options(*verb, *options);
    verb->callback([options] { design_gyro(*options); });
}

}  // namespace zlg::cli
