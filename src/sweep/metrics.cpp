#include <zlg/sweep/metrics.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include <zlg/study/fields.hpp>
#include <zlg/text/spelling.hpp>

namespace zlg::sweep {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view configured = "configured";
constexpr std::string_view one_mode = "one_mode";  // which has no switch
constexpr std::string_view magnetic_estimate = "magnetic_estimate";
constexpr int profile_ticks = 8;  // of relock_false_drift_deg_h

constexpr std::array<std::string_view, 10> variants{
    one_mode,          "switching",     "relock_frequency", "relock_detuning", "relock_mean_square",
    "bridge_constant", "bridge_linear", "bridge_quadratic", magnetic_estimate, configured};

using Getter = std::function<double(const study::RunResult&)>;
using Getters = std::map<std::string, Getter, std::less<>>;

const study::VariantResult* find(const study::RunResult& result, std::string_view name) {
    return name == magnetic_estimate ? &result.magnetic_estimate : result.variant(name);
}

void add(Getters& getters, std::string_view variant, const std::string& field,
         const std::function<double(const study::VariantResult&)>& get) {
    getters[fmt::format("{}.{}", variant, field)] = [variant, get](const study::RunResult& result) {
        const study::VariantResult* found = find(result, variant);
        return found != nullptr ? get(*found) : unknown;
    };
}

void add_variant(Getters& getters, std::string_view variant) {
    study::for_each_field<study::VariantResult>([&](const std::string& name, auto get) {
        if constexpr (std::is_convertible_v<decltype(get(study::VariantResult{})), double>)
            add(getters, variant, name, [get](const study::VariantResult& v) { return get(v); });
    });
    if (variant == one_mode) return;
    add(getters, variant, "switches_unrepaired",
        [](const study::VariantResult& v) { return static_cast<double>(v.unrepaired); });
    study::for_each_field<study::SwitchStatistics>([&](const std::string& name, auto get) {
        add(getters, variant, "switch_error_" + name,
            [get](const study::VariantResult& v) { return v.switch_error ? get(*v.switch_error) : unknown; });
    });
}

Getters all_getters() {
    using Result = study::RunResult;
    Getters getters{
        {"duration_s", [](const Result& r) { return static_cast<double>(r.ticks) * r.tick_s; }},
        {"ticks", [](const Result& r) { return static_cast<double>(r.ticks); }},
        {"switches", [](const Result& r) { return static_cast<double>(r.switches.size()); }},
        {"switches_failed", [](const Result& r) { return static_cast<double>(r.tally.failed); }},
        {"switches_withheld", [](const Result& r) { return static_cast<double>(r.tally.withheld); }},
        {"ticks_as_whole_counts", [](const Result& r) { return static_cast<double>(r.whole_count_ticks); }},
        {"ticks_invalid", [](const Result& r) { return static_cast<double>(r.invalid_ticks); }},
    };
    for (const std::string_view variant : variants) add_variant(getters, variant);
    for (std::size_t k = 0; k < profile_ticks; ++k)
        getters[fmt::format("relock_false_drift_deg_h.{}", k + 1)] = [k](const Result& r) {
            return k < r.relock_false_drift_deg_h.size() ? r.relock_false_drift_deg_h[k] : unknown;
        };
    return getters;
}

const Getters& getters() {
    static const Getters all = all_getters();
    return all;
}

}  // namespace

bool is_metric(std::string_view name) { return getters().contains(name); }

const std::vector<std::string>& metric_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> made;
        for (const auto& [name, getter] : getters()) made.push_back(name);
        return made;
    }();
    return names;
}

// Of the same variant, where it names one.
std::string nearest_metric(std::string_view name) {
    const std::string_view variant = name.substr(0, name.find('.') + 1);
    const bool has_variant = std::ranges::any_of(
        metric_names(), [&](const std::string& known) { return !variant.empty() && known.starts_with(variant); });
    const auto apart = [&](const std::string& known) {
        const bool is_other = has_variant && !known.starts_with(variant);
        return std::pair{is_other, text::letters_apart(known, name)};
    };
    return *std::ranges::min_element(metric_names(), {}, apart);
}

std::optional<std::string> variant_of(std::string_view metric) {
    const std::string_view first = metric.substr(0, metric.find('.'));
    const bool is_other = first != configured && std::ranges::find(variants, first) != variants.end();
    return is_other ? std::optional{std::string{first}} : std::nullopt;
}

double metric_of(const study::RunResult& result, std::string_view metric) {
    const auto found = getters().find(metric);
    return found == getters().end() ? unknown : found->second(result);
}

std::string unit_of(std::string_view metric) {
    if (metric.starts_with("relock_false_drift_deg_h")) return "deg/h";
    if (metric.ends_with("_arcsec_s")) return "arcsec/s";
    if (metric.ends_with("_arcsec")) return "arcsec";
    return metric.ends_with("_s") ? "s" : "1";
}

}  // namespace zlg::sweep
