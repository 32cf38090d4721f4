// An answer as JSON, and as a configuration.
#include <zlg/choice/choose.hpp>

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/study/how_made.hpp>

namespace zlg::choice {
namespace {

using nlohmann::json;

// TOML of one value; what is no JSON too stays a text.
json value_json(const std::string& toml) {
    json value = json::parse(toml, nullptr, false);
    return value.is_discarded() ? json(toml) : value;
}

json number_json(double x) { return std::isfinite(x) ? json(x) : json(nullptr); }

json choice_json(const Requirement& r, const Candidate& candidate) {
    json choice = json::object();
    for (const auto& [key, value] : chosen_keys(r.base, candidate)) {
        const std::size_t dot = key.find('.');
        choice[key.substr(0, dot)][key.substr(dot + 1)] = value_json(value);
    }
    return choice;
}

}  // namespace

std::string json_text(const Requirement& requirement, const Answer& a) {
    json budget = json::object();
    for (const auto& [name, value] : a.budget) budget[name] = number_json(value);
    for (const Part& part : a.parts) budget["parts_rms_arcsec"][part.name] = number_json(part.rms_arcsec);
    json needs = json::array();
    for (const Need& n : a.would_need)
        needs.push_back({{"keys", n.keys},
                         {"from", n.from},
                         {"to", n.is_enough ? json(n.to) : json(nullptr)},
                         {"enough", n.is_enough},
                         {"share", n.share},
                         {"gyros", n.tried},
                         {"sentence", n.sentence}});
    json j{{"met", a.met},
           {"interrupted", a.is_interrupted},
           {"probability", a.probability},
           {"probability_sigma", a.probability_sigma},
           {"gyros", a.proof.trials.size()},
           {"refused", a.refused},
           {"lost", a.lost},
           {"required_arcsec", requirement.limit_arcsec()},
           {"least_arcsec", number_json(a.least_arcsec)},
           {"confidence", requirement.confidence},
           {"choice", choice_json(requirement, a.proof.candidate)},
           {"reasons", a.reasons},
           {"budget", std::move(budget)},
           {"binding", a.binding},
           {"would_need", std::move(needs)},
           {"proofs", a.proofs},
           {"simulated",
            {{"gyros", a.simulated.trials.size()},
             {"met", a.simulated.met(requirement.limit_arcsec())},
             {"rms_arcsec", a.simulated.rms_arcsec()}}}};
    if (a.runner_up)
        j["runner_up"] = {{"choice", choice_json(requirement, a.runner_up->candidate)},
                          {"probability", a.runner_up->share(requirement.limit_arcsec())},
                          {"gyros", a.runner_up->trials.size()}};
    return j.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string toml_text(const Requirement& requirement, const Answer& a) {
    return fmt::format("# {} {:.6g} arcsec after {:.6g} s: {:.4f} +- {:.4f} of {} gyros, asked were {}\n{}",
                       a.met ? "chosen for" : "does not meet", requirement.limit_arcsec(), requirement.run_s,
                       a.probability, a.probability_sigma, a.proof.trials.size(), requirement.confidence,
                       study::own_settings(a.gyro));
}

}  // namespace zlg::choice
