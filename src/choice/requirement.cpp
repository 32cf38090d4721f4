#include <zlg/choice/requirement.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/recorded/motion.hpp>
#include <zlg/study/gyro_drift.hpp>
#include <zlg/sweep/description_table.hpp>
#include <zlg/text/inputs.hpp>
#include <zlg/text/toml_text.hpp>
#include <zlg/text/whole_file.hpp>

#include "ramps.hpp"

namespace zlg::choice {
namespace {

using config::ConfigError;
using sweep::Table;

// What is drawn is what the gyro is, not what is chosen for it.
constexpr std::array chosen_sections{"switching.", "compensation.", "run.", "require.", "field."};
constexpr std::array chosen_names{"gyro.tick_s",      "gyro.readout",   "gyro.fidelity",
                                  "laser.quadrature", "perimeter.loop", "temperature.profile"};

bool is_chosen(const std::string& key) {
    return std::ranges::any_of(chosen_sections, [&](const char* section) { return key.starts_with(section); }) ||
           std::ranges::find(chosen_names, key) != chosen_names.end();
}

double positive(const Table& table, std::string_view key) {
    const double value = table.real(key);
    if (!(value > 0.0)) table.refuse(key, "a number above 0");
    return value;
}

void read_base(const Table& root, Requirement& r) {
    for (const auto& [section, keys] : root.table()) {
        const std::string name{section.str()};
        if (name == "require" || name == "tolerance") continue;
        if (!keys.is_table()) root.fail(keys, fmt::format("{}: allowed are sections, as [gyro]", name));
        for (const auto& [key, node] : *keys.as_table())
            config::apply_pair(r.base, fmt::format("{}.{}", name, key.str()), sweep::text_of(node),
                               fmt::format("{}:{}", root.source_name(), node.source().begin.line));
    }
}

void read_ticks(const Table& require, Requirement& r) {
    if (!require.has("tick_s")) return;
    const toml::node& node = require.node("tick_s");
    if (!node.is_table()) require.refuse("tick_s", "{ min = , max = }");
    const Table range{require.source_name(), "require.tick_s", *node.as_table()};
    range.allow_only({"min", "max"});
    if (range.has("min")) r.tick_min_s = positive(range, "min");
    if (range.has("max")) r.tick_max_s = positive(range, "max");
    if (!(r.tick_min_s <= r.tick_max_s))
        require.refuse("tick_s", fmt::format("min <= max; here they are {} and {} s", r.tick_min_s, r.tick_max_s));
}

void read_demands(const Table& require, Requirement& r) {
    require.allow_only({"run_s", "angle_error_arcsec", "drift_arcsec_s", "confidence", "tick_s",
                        "angular_acceleration_arcsec_s2", "delay_s", "gyros"});
    r.run_s = positive(require, "run_s");
    if (require.has("angle_error_arcsec")) r.angle_error_arcsec = positive(require, "angle_error_arcsec");
    if (require.has("drift_arcsec_s")) r.drift_arcsec_s = positive(require, "drift_arcsec_s");
    if (!r.angle_error_arcsec && !r.drift_arcsec_s)
        require.fail("angle_error_arcsec and drift_arcsec_s are missing: give one at least");
    if (require.has("confidence")) r.confidence = require.real("confidence");
    if (!(r.confidence > 0.0 && r.confidence < 1.0)) require.refuse("confidence", "a number between 0 and 1");
    if (require.has("angular_acceleration_arcsec_s2"))
        r.angular_acceleration_arcsec_s2 = require.real("angular_acceleration_arcsec_s2");
    if (!(r.angular_acceleration_arcsec_s2 >= 0.0))
        require.refuse("angular_acceleration_arcsec_s2", "a number of 0 or more");
    if (require.has("delay_s")) r.delay_s = positive(require, "delay_s");
    constexpr std::int64_t most_gyros = 1'000'000;
    if (require.has("gyros")) r.gyros = require.integer("gyros", 1, most_gyros);
}

// [[tolerance]] out of what else may be written: [tolerance] alone for one parameter, [[tolerance.parameter]].
void make_list_of_tolerances(toml::table& document) {
    toml::node* node = document.get("tolerance");
    if (node == nullptr || !node->is_table()) return;
    toml::table table = std::move(*node->as_table());
    toml::array list;
    if (toml::node* parameters = table.get("parameter"); parameters != nullptr && parameters->is_array())
        list = std::move(*parameters->as_array());
    else
        list.push_back(std::move(table));
    document.insert_or_assign("tolerance", std::move(list));
}

std::vector<sweep::Parameter> read_tolerance(const Table& root, const config::Config& base) {
    std::vector<sweep::Parameter> drawn = sweep::read_parameters(root, "tolerance", base);
    for (const sweep::Parameter& p : drawn)
        for (const std::string& key : p.keys)
            if (is_chosen(key))
                throw ConfigError{
                    fmt::format("{}: [[tolerance]] keys = [\"{}\"]: that is chosen or said elsewhere; allowed is "
                                "what the gyro is",
                                root.source_name(), key)};
    return drawn;
}

// A peak of the motion that is known without a file; the counter loses fringes beyond its limit.
void refuse_fast_ramps(const Requirement& r, std::string_view source_name) {
    if (r.angular_acceleration_arcsec_s2 == 0.0) return;
    const config::Gyro& g = r.base.gyro;
    constexpr double highest_arcsec_s = 400.0 * 3600.0;  // that the counter follows beside the bias
    double motion_arcsec_s = std::abs(r.base.motion.rate_arcsec_s);
    if (r.base.motion.kind == config::MotionKind::sine || r.base.motion.kind == config::MotionKind::sum)
        for (const double amplitude : r.base.motion.amplitude_arcsec_s) motion_arcsec_s += std::abs(amplitude);
    const double most =
        (g.counter_max_hz ? (*g.counter_max_hz - g.bias_hz) * g.scale_arcsec : highest_arcsec_s) - motion_arcsec_s;
    if (!(r.angular_acceleration_arcsec_s2 * ramp_s <= most))
        throw ConfigError{fmt::format(
            "{}: [require] angular_acceleration_arcsec_s2 = {}: a ramp of {} s reaches a rate that the counter does "
            "not follow; allowed is up to {:.6g} beside this motion",
            source_name, r.angular_acceleration_arcsec_s2, ramp_s, std::max(0.0, most / ramp_s))};
}

void check_whole(const Requirement& r, std::string_view source_name) {
    const auto refuse = [&](const std::string& what) {
        throw ConfigError{fmt::format("{}: [require] {}", source_name, what)};
    };
    if (config::is_given(r.base, "switching.interval_s") && !r.base.switching.interval_optimal &&
        r.base.switching.interval_s > r.run_s)
        refuse(fmt::format("run_s = {}: is shorter than switching.interval_s = {}; allowed is that much or more",
                           r.run_s, r.base.switching.interval_s));
    if (!(r.run_s >= 10.0 * r.tick_max_s))
        refuse(fmt::format("run_s = {}: allowed is ten ticks of {} s or more", r.run_s, r.tick_max_s));
    if (r.base.gyro.fidelity == config::Fidelity::laser)
        refuse(
            "is answered on averaged gyros; allowed is gyro.fidelity = \"averaged\", with the constants of the laser");
    const double available_s = recorded::motion(r.base).duration_s();
    if (r.run_s > available_s * (1.0 + 1e-12))
        refuse(fmt::format("run_s = {}: the motion file lasts {} s; allowed is up to that", r.run_s, available_s));
    refuse_fast_ramps(r, source_name);
    (void)study::gyro_drift(r.base);
}

}  // namespace

double Requirement::limit_arcsec() const {
    constexpr double none = std::numeric_limits<double>::infinity();
    return std::min(angle_error_arcsec.value_or(none), drift_arcsec_s ? *drift_arcsec_s * run_s : none);
}

Requirement parse_requirement(std::string_view text, std::string_view source_name,
                              const std::vector<std::string>& sets) {
    toml::table document = sweep::parse_document(text, source_name);
    make_list_of_tolerances(document);
    const Table root{source_name, "require", document};
    if (!root.node("require").is_table()) root.fail(root.node("require"), "require is a section: write [require] once");
    Requirement r;
    read_base(root, r);
    for (const std::string& set : sets) config::apply_set(r.base, set);
    if (r.base.run.duration_s) throw ConfigError{fmt::format("{}: run.duration_s: is require.run_s here", source_name)};
    r.tick_min_s = r.tick_max_s = r.base.gyro.tick_s;
    const Table require{source_name, "require", *root.node("require").as_table()};
    read_demands(require, r);
    read_ticks(require, r);
    config::apply_pair(r.base, "run.duration_s", text::toml_real(r.run_s), source_name);
    config::check(r.base);
    if (r.base.motion.kind == config::MotionKind::file) text::note_input(r.base.motion.path);
    r.tolerance = read_tolerance(root, r.base);
    check_whole(r, source_name);
    return r;
}

Requirement read_requirement(const std::string& path, const std::vector<std::string>& sets) {
    try {
        return parse_requirement(text::read_whole(path), path, sets);
    } catch (const text::CannotRead& error) {
        throw ConfigError(fmt::format("cannot read the requirement {}: {}", path, error.what()));
    }
}

}  // namespace zlg::choice
