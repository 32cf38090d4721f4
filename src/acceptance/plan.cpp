#include <zlg/acceptance/plan.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <zlg/acceptance/quantity.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/study/analyze.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/toml_document.hpp>
#include <zlg/text/toml_text.hpp>
#include <zlg/text/whole_file.hpp>

namespace zlg::acceptance {
namespace {

constexpr std::array<std::string_view, 6> kinds{"static",   "rate_table",  "warm_up",
                                                "magnetic", "temperature", "switching"};

// A node of the plan with the words for it: "plan.toml:7: [[run]] 2 files".
struct At {
    const std::string& path;
    std::string name;
    const toml::node& node;

    [[nodiscard]] std::string place() const { return fmt::format("{}:{}: {}", path, node.source().begin.line, name); }
    [[noreturn]] void fail(std::string_view what) const {
        throw config::ConfigError(fmt::format("{}: {}", place(), what));
    }
    [[nodiscard]] At in(std::string_view key, const toml::node& value) const {
        return {path, fmt::format("{} {}", name, key), value};
    }

    [[nodiscard]] const toml::table& table() const {
        if (!node.is_table()) fail("allowed is a section");
        return *node.as_table();
    }
    [[nodiscard]] const toml::array& array(std::string_view of) const {
        if (!node.is_array() || node.as_array()->empty()) fail(fmt::format("allowed is a list of {}", of));
        return *node.as_array();
    }
    [[nodiscard]] std::string text() const {
        const auto* found = node.as_string();
        if (found == nullptr) fail("allowed is a text");
        return found->get();
    }
    // Also a date or a number, as it stands there.
    [[nodiscard]] std::string words() const {
        if (node.is_string()) return text();
        if (!node.is_date() && !node.is_integer()) fail("allowed is a text");
        std::ostringstream out;
        node.visit([&](const auto& value) { out << value; });
        return out.str();
    }
    [[nodiscard]] double real(double min, double max) const {
        const auto value = node.is_number() ? node.value<double>() : std::nullopt;
        if (!value || !(*value >= min && *value <= max))
            fail(fmt::format("{}allowed is a number {:g}..{:g}", value ? fmt::format("{:g}; ", *value) : "", min, max));
        return *value;
    }
};

constexpr double any = 1e300;

using Keys = std::map<std::string_view, std::function<void(const At&)>>;

// Each key of a section by its own function; `other` takes those that have none.
void read_keys(const At& at, const Keys& keys, const std::function<void(const At&, std::string_view)>& other = {}) {
    for (const auto& [key, node] : at.table()) {
        const auto found = keys.find(key.str());
        const At value = at.in(key.str(), node);
        if (found != keys.end()) {
            found->second(value);
        } else if (other) {
            other(value, key.str());
        } else {
            std::vector<std::string_view> allowed;
            for (const auto& [name, read] : keys) allowed.push_back(name);
            at.fail(fmt::format("unknown key '{}'; allowed are {}", text::excerpt(key.str(), 60, ' '),
                                fmt::join(allowed, ", ")));
        }
    }
}

Unit unit_of(const At& at) {
    Unit unit;
    const auto words = [](std::string& to) { return [&to](const At& v) { to = v.words(); }; };
    read_keys(at, {{"serial", words(unit.serial)},
                   {"type", words(unit.type)},
                   {"operator", words(unit.operator_name)},
                   {"equipment", words(unit.equipment)},
                   {"date", words(unit.date)},
                   {"scale_arcsec", [&](const At& v) { unit.scale_arcsec = v.real(1e-6, 1e6); }},
                   {"latitude_deg", [&](const At& v) { unit.latitude_deg = v.real(-90.0, 90.0); }}});
    if (unit.serial.empty()) at.fail("serial is missing: which gyro was tested?");
    return unit;
}

Stage stage_of(const At& at) {
    Stage stage;
    read_keys(at, {{"from_s", [&](const At& v) { stage.from_s = v.real(0.0, 1e9); }},
                   {"to_s", [&](const At& v) { stage.to_s = v.real(0.0, 1e9); }},
                   {"rate_deg_s", [&](const At& v) { stage.rate_arcsec_s = 3600.0 * v.real(-1e5, 1e5); }}});
    if (at.table().size() != 3) at.fail("allowed is from_s, to_s and rate_deg_s together");
    if (!(stage.from_s < stage.to_s))
        at.fail(fmt::format("to_s = {:g}; allowed is above from_s = {:g}", stage.to_s, stage.from_s));
    return stage;
}

std::vector<Stage> stages_of(const At& at) {
    std::vector<Stage> stages;
    for (const toml::node& node : at.array("stages")) {
        stages.push_back(stage_of({at.path, at.name, node}));
        if (stages.size() > 1 && stages.back().from_s < stages[stages.size() - 2].to_s)
            at.fail(fmt::format("stage {} begins before the one before it has ended", stages.size()));
    }
    return stages;
}

std::vector<std::string> files_of(const At& at) {
    std::vector<std::string> files;
    if (at.node.is_string()) return {at.text()};
    for (const toml::node& node : at.array("names of files")) files.push_back(At{at.path, at.name, node}.text());
    return files;
}

// A value of `import --map`, as that option has it.
void map_to(Run& run, const At& at, std::string_view key) {
    const auto* real = at.node.as_floating_point();
    run.mapping.set(std::string{key}, real != nullptr ? fmt::format("{}", real->get()) : at.words(), at.place());
}

Run run_of(const At& at, const Unit& unit) {
    Run run;
    run.place = at.place();
    bool has_kind = false;
    std::optional<At> axis;
    const Keys keys{{"files", [&](const At& v) { run.files = files_of(v); }},
                    {"kind", [&](const At& v) { run.kind = kind_of(v.text(), v.place()), has_kind = true; }},
                    {"stages", [&](const At& v) { run.stages = stages_of(v); }},
                    {"serial", [&](const At& v) { run.serial = v.words(); }},
                    {"field_mt", [&](const At& v) { run.field_mt = v.real(-1e3, 1e3); }},
                    {"axis", [&](const At& v) { axis.emplace(v), run.axis = v.words(); }},
                    {"column", [&](const At& v) { map_to(run, v, "axis"); }}};
    read_keys(at, keys, [&](const At& v, std::string_view key) { map_to(run, v, key); });
    if (!has_kind) at.fail(fmt::format("kind is missing; allowed is {}", fmt::join(kinds, ", ")));
    if (run.files.empty()) at.fail("files is missing: a run needs its logs");
    // A word that is no direction is the column of a file of another program.
    if (axis && !earth_about({.latitude_deg = 0.0}, run.axis) && !run.mapping.has("axis")) map_to(run, *axis, "axis");
    if (axis && !unit.latitude_deg && earth_about({.latitude_deg = 45.0}, run.axis).value_or(0.0) != 0.0)
        axis->fail("the Earth's rotation about it needs latitude_deg of [unit]");
    if (unit.scale_arcsec && !run.mapping.has("scale_arcsec") &&
        (run.mapping.has("counts") || run.mapping.text("unit").starts_with("count")))
        run.mapping.set("scale_arcsec", fmt::format("{}", *unit.scale_arcsec), at.place());
    return run;
}

Limit limit_of(const At& at, std::string_view name, const std::vector<Run>& runs) {
    const QuantityInfo* quantity = find_quantity(name);
    if (quantity == nullptr)
        throw config::ConfigError(
            fmt::format("{}:{}: [limits] {}", at.path, at.node.source().begin.line, unknown_quantity(name)));
    Limit limit{.name = std::string{name}, .min = {}, .max = {}};
    read_keys(at, {{"min", [&](const At& v) { limit.min = v.real(-any, any); }},
                   {"max", [&](const At& v) { limit.max = v.real(-any, any); }}});
    if (!limit.min && !limit.max) at.fail("allowed is { min = , max = }, or one of them");
    if (limit.min && limit.max && !(*limit.min <= *limit.max))
        at.fail(fmt::format("min = {:g} is above max = {:g}", *limit.min, *limit.max));
    const auto serves = [&](const Run& run) { return std::ranges::count(quantity->kinds, run.kind) > 0; };
    if (std::ranges::any_of(runs, serves)) return limit;
    std::vector<std::string_view> needed;
    for (const RunKind kind : quantity->kinds) needed.push_back(name_of(kind));
    at.fail(fmt::format("no run of the plan gives it; it needs a run of kind {}", fmt::join(needed, " or ")));
}

Plan plan_of(const std::string& path, const toml::table& root) {
    Plan plan{.path = path, .unit = {}, .runs = {}, .limits = {}};
    for (const auto& [key, node] : root) {
        const At at{path, fmt::format("[{}]", key.str()), node};
        if (key != "unit" && key != "run" && key != "limits" && key != "accept")
            at.fail("unknown section; allowed are [unit], [[run]], [limits], [accept]");
    }
    const auto section = [&](std::string_view name) -> const toml::node* { return root.get(name); };
    if (section("unit") == nullptr) throw config::ConfigError(fmt::format("{}: [unit] is missing, with serial", path));
    plan.unit = unit_of({path, "[unit]", *section("unit")});
    if (section("run") == nullptr)
        throw config::ConfigError(fmt::format("{}: [[run]] is missing: a plan needs logs", path));
    const At runs{path, "[[run]]", *section("run")};
    for (const toml::node& node : runs.array("runs, [[run]]")) {
        const int number = static_cast<int>(plan.runs.size()) + 1;
        plan.runs.push_back(run_of({path, fmt::format("[[run]] {}", number), node}, plan.unit));
        plan.runs.back().number = number;
    }
    if (section("limits") != nullptr)
        for (const auto& [key, node] : At{path, "[limits]", *section("limits")}.table())
            plan.limits.push_back(limit_of({path, fmt::format("[limits] {}", text::excerpt(key.str(), 60, ' ')), node},
                                           key.str(), plan.runs));
    if (section("accept") != nullptr)
        read_keys({path, "[accept]", *section("accept")},
                  {{"risk", [&](const At& v) { plan.risk = v.real(1e-6, 0.49); }},
                   {"warm_up_band_deg_h", [&](const At& v) { plan.warm_up_band_deg_h = v.real(1e-9, 1e9); }}});
    return plan;
}

}  // namespace

RunKind kind_of(std::string_view name, const std::string& where) {
    const auto found = std::ranges::find(kinds, name);
    if (found == kinds.end())
        throw config::ConfigError(
            fmt::format("{} = '{}'; allowed is {}", where, text::excerpt(name, 60, ' '), fmt::join(kinds, ", ")));
    return static_cast<RunKind>(found - kinds.begin());
}

std::string_view name_of(RunKind kind) { return kinds.at(static_cast<std::size_t>(kind)); }

std::optional<double> earth_about(const Unit& unit, std::string_view axis) {
    if (!unit.latitude_deg) return std::nullopt;
    const double latitude = *unit.latitude_deg * std::numbers::pi / 180.0;
    const double up = study::earth_rate_arcsec_s * std::sin(latitude);
    const double north = study::earth_rate_arcsec_s * std::cos(latitude);
    const std::array<std::pair<std::string_view, double>, 6> directions{
        {{"up", up}, {"down", -up}, {"north", north}, {"south", -north}, {"east", 0.0}, {"west", 0.0}}};
    const auto found = std::ranges::find(directions, axis, &std::pair<std::string_view, double>::first);
    return found == directions.end() ? std::nullopt : std::optional{found->second};
}

Plan read_plan(const std::string& path) {
    try {
        return plan_of(path, text::parse_toml(text::read_whole(path)));
    } catch (const toml::parse_error& error) {
        throw config::ConfigError(fmt::format("{}:{}: {}; allowed is TOML", path, error.source().begin.line,
                                              std::string{error.description()}));
    } catch (const text::CannotRead& error) {
        throw logs::IoError(fmt::format("cannot read {}: {}", path, error.what()));
    } catch (const text::TooLong& error) {
        throw config::ConfigError(error.what());
    }
}

}  // namespace zlg::acceptance
