// A description out of TOML, with every fault of it named by file and line.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include <zlg/sweep/description.hpp>
#include <zlg/sweep/description_table.hpp>
#include <zlg/sweep/metrics.hpp>
#include <zlg/text/toml_document.hpp>
#include <zlg/text/toml_text.hpp>

namespace zlg::sweep {
namespace {

constexpr std::size_t max_grid_values = 1'000'000;

// The gyros differ in their seeds, and last equally long.
void refuse_run_keys(const Table& table, const std::string& key) {
    if (key == "run.seed") table.fail("run.seed: each gyro has its own, from sweep.seed");
    if (key == "run.duration_s") table.fail("run.duration_s: is sweep.duration_s here");
}

// Beyond 2^53, where doubles skip integers, an integer stays a text, so that every digit arrives.
bool is_exact(const toml::node& node) {
    constexpr std::int64_t largest = std::int64_t{1} << 53;
    const auto* integer = node.as_integer();
    return integer == nullptr || (integer->get() <= largest && integer->get() >= -largest);
}

Value value_of(const Table& table, const toml::node& node) {
    const std::optional<double> number = number_of(node);
    if (number && std::isfinite(*number) && is_exact(node)) return *number;
    if (node.is_string() || node.is_boolean() || node.is_array() || node.is_integer()) return text_of(node);
    table.fail(node, fmt::format("values: {}: allowed are numbers, texts and arrays", text_of(node)));
}

constexpr double largest_number = std::numeric_limits<double>::max();

// The width of a range is a number as well.
void check_range(const Table& table, double min, double max) {
    if (!(min < max)) table.refuse("max", fmt::format("a number above min = {}", text::toml_real(min)));
    if (!std::isfinite(max - min))
        table.refuse("max", fmt::format("a number less than {} above min = {}", largest_number, text::toml_real(min)));
}

// From min to max in n - 1 equal steps.
std::vector<Value> spaced(const Table& table) {
    const double min = table.real("min");
    const double max = table.real("max");
    const auto n = static_cast<std::size_t>(table.integer("n", 2, max_grid_values));
    check_range(table, min, max);
    std::vector<Value> values;
    for (std::size_t k = 0; k < n; ++k) {
        const double place = static_cast<double>(k) / static_cast<double>(n - 1);
        values.emplace_back(k + 1 == n ? max : min + (max - min) * place);
    }
    return values;
}

void read_values(const Table& table, Parameter& p) {
    if (p.draw == DrawKind::grid && !table.has("values")) {
        table.allow_only({"keys", "draw", "min", "max", "n"});
        p.values = spaced(table);
        return;
    }
    table.allow_only({"keys", "draw", "values"});
    const toml::array* array = table.node("values").as_array();
    if (array == nullptr || array->empty()) table.refuse("values", "an array of one value at least");
    for (const toml::node& node : *array) p.values.push_back(value_of(table, node));
}

// The part of the normal law within [min, max].
double share_within(const Parameter& p) {
    const auto below = [&](double x) { return 0.5 * std::erfc((p.mean - x) / (p.sd * std::sqrt(2.0))); };
    return below(p.max) - below(p.min);
}

void read_law(const Table& table, Parameter& p) {
    constexpr double least_share = 1e-3;  // so that few numbers are drawn in vain
    if (!has_range(p.draw))
        table.allow_only({"keys", "draw", "mean", "sd"});
    else if (!has_mean(p.draw))
        table.allow_only({"keys", "draw", "min", "max"});
    else
        table.allow_only({"keys", "draw", "min", "max", "mean", "sd"});
    if (has_range(p.draw)) {
        p.min = table.real("min");
        p.max = table.real("max");
        if (p.draw == DrawKind::log_uniform && !(p.min > 0.0)) table.refuse("min", "a number above 0 for log_uniform");
        check_range(table, p.min, p.max);
        if (p.draw == DrawKind::log_uniform && !std::isfinite(p.max / p.min))
            table.refuse("max", fmt::format("less than {} times min = {}", largest_number, text::toml_real(p.min)));
    }
    if (!has_mean(p.draw)) return;
    p.mean = table.real("mean");
    p.sd = table.real("sd");
    if (!(p.sd > 0.0)) table.refuse("sd", "a number above 0");
    constexpr double furthest_sd = 40.0;  // no deviate of a double is so far
    if (!std::isfinite(std::abs(p.mean) + furthest_sd * p.sd))
        table.refuse("sd", fmt::format("one with mean +- {} sd below {}", furthest_sd, largest_number));
    if (p.draw == DrawKind::truncated && !(share_within(p) >= least_share))
        table.refuse("mean", fmt::format("one that leaves at least {} of the law within min and max", least_share));
}

DrawKind draw_kind(const Table& table) {
    const auto found = std::ranges::find(draw_names, table.text("draw"));
    if (found == draw_names.end()) table.refuse("draw", fmt::format("one of {}", fmt::join(draw_names, ", ")));
    return static_cast<DrawKind>(found - draw_names.begin());
}

void read_keys(const Table& table, Parameter& p) {
    const toml::node& node = table.node("keys");
    const toml::array* array = node.as_array();
    if (array == nullptr || array->empty()) table.refuse("keys", "an array of one key at least");
    for (const toml::node& key : *array) {
        if (!key.is_string()) table.refuse("keys", "an array of keys, as \"piezo.half_wave_v\"");
        p.keys.push_back(key.as_string()->get());
        refuse_run_keys(table, p.keys.back());
    }
}

// What a key does not take shows before any gyro runs, at the ends of the range at least.
void try_values(const Table& table, const Parameter& p, const config::Config& base,
                const std::map<std::string, config::ValueKind>& kinds) {
    std::vector<Value> tried = p.values;
    if (has_range(p.draw)) tried = {p.min, p.max};
    if (p.draw == DrawKind::normal) tried = {p.mean};
    for (const std::string& key : p.keys) {
        for (const Value& value : tried) {
            config::Config scratch = base;
            config::apply_pair(scratch, key, toml_of(value), table.place());
        }
        if (!has_values(p.draw) && kinds.at(key) == config::ValueKind::integer)
            table.fail(fmt::format("{} takes integers, which draw = \"{}\" does not give; allowed are grid and list",
                                   key, name_of(p.draw)));
    }
}

Parameter read_parameter(const Table& table) {
    Parameter p;
    p.draw = draw_kind(table);
    read_keys(table, p);
    if (has_values(p.draw))
        read_values(table, p);
    else
        read_law(table, p);
    return p;
}

Metric read_metric(const Table& table) {
    table.allow_only({"name", "min", "max"});
    Metric metric{table.text("name"), table.optional_real("min"), table.optional_real("max")};
    if (!is_metric(metric.name))
        table.fail(fmt::format("name = {}: there is no such number in the summary of a run; did you mean {}?",
                               metric.name, nearest_metric(metric.name)));
    if (metric.min && metric.max && !(*metric.min <= *metric.max))
        table.refuse("max", fmt::format("a number of min = {} or more", text::toml_real(*metric.min)));
    return metric;
}

// use(table) for each of [[name]].
template <class Use> void for_each_table(const Table& root, const std::string& name, const Use& use) {
    if (!root.has(name)) return;
    const toml::array* array = root.node(name).as_array();
    if (array == nullptr || !array->is_array_of_tables())
        root.fail(root.node(name), fmt::format("{} is a list of tables: write [[{}]] above each", name, name));
    for (const toml::node& node : *array) use(Table{root.source_name(), name, *node.as_table()});
}

// One key is one line of the canonical text, whatever section it was written in.
void read_base(const Table& root, std::string_view source_name, Description& d) {
    if (!root.has("base")) return;
    if (!root.node("base").is_table()) root.fail(root.node("base"), "base: allowed are sections, as [base.gyro]");
    config::Config scratch;
    for (const auto& [section, keys] : *root.node("base").as_table()) {
        const std::string place = fmt::format("{}:{}", source_name, keys.source().begin.line);
        if (!keys.is_table())
            throw config::ConfigError(
                fmt::format("{}: [base] {}: allowed are sections, as [base.gyro]", place, section.str()));
        for (const auto& [name, node] : *keys.as_table()) {
            const std::string key = fmt::format("{}.{}", section.str(), name.str());
            refuse_run_keys(Table{source_name, "base", *keys.as_table()}, key);
            config::apply_pair(scratch, key, text_of(node),
                               fmt::format("{}:{}: [base]", source_name, node.source().begin.line));
            d.base.emplace_back(key, text_of(node));
        }
    }
    std::ranges::sort(d.base);
}

void read_motion_checksums(const Table& root, std::string_view source_name, Description& d) {
    if (!root.has("motion_checksums")) return;
    const toml::node& node = root.node("motion_checksums");
    if (!node.is_table()) root.fail(node, "motion_checksums is a section: write [motion_checksums] once");
    const Table table{source_name, "motion_checksums", *node.as_table()};
    for (const auto& [path, checksum] : table.table()) {
        const std::string name{path.str()};
        d.motion_checksums[name] = table.text(name);
    }
}

// Before any value is tried.
void refuse_large_grid(const Table& table, const Description& d, const Parameter& p) {
    if (p.draw == DrawKind::grid && grid_points(d) > max_gyros / static_cast<std::int64_t>(p.values.size()))
        table.fail(
            fmt::format("the grid has more than {} points with this parameter; allowed is that many", max_gyros));
}

void read_metrics(const Table& root, Description& d) {
    std::set<std::string> names;
    for_each_table(root, "metric", [&](const Table& table) {
        d.metrics.push_back(read_metric(table));
        if (!names.insert(d.metrics.back().name).second)
            table.fail(fmt::format("name = {} stands twice; allowed is once", d.metrics.back().name));
    });
    if (d.metrics.empty())
        root.fail(fmt::format("no [[metric]]: name one at least, as {}", "configured.switch_error_rms_arcsec"));
}

// A grid tells how many gyros it has; each point may be run several times.
void read_gyros(const Table& sweep, Description& d) {
    const std::int64_t points = grid_points(d);
    const bool has_grid =
        std::ranges::any_of(d.parameters, [](const Parameter& p) { return p.draw == DrawKind::grid; });
    d.n_gyros = has_grid && !sweep.has("gyros") ? points : sweep.integer("gyros", 1, max_gyros);
    if (has_grid && d.n_gyros % points != 0)
        sweep.refuse("gyros", fmt::format("a multiple of the {} points of the grid, or nothing", points));
}

}  // namespace

toml::table parse_document(std::string_view text, std::string_view source_name) {
    try {
        return text::parse_toml(text);
    } catch (const toml::parse_error& error) {
        const auto& at = error.source().begin;
        throw config::ConfigError(fmt::format("{}:{}:{}: {}", source_name, at.line, at.column, error.description()));
    }
}

std::vector<Parameter> read_parameters(const Table& root, const std::string& name, const config::Config& base) {
    std::map<std::string, config::ValueKind> kinds;
    for (const config::KeyInfo& key : config::describe_keys()) kinds[key.section + "." + key.name] = key.kind;
    std::set<std::string> driven;
    Description d;
    for_each_table(root, name, [&](const Table& table) {
        Parameter p = read_parameter(table);
        refuse_large_grid(table, d, p);
        for (const std::string& key : p.keys)
            if (!driven.insert(key).second)
                table.fail(fmt::format("{} is driven twice; allowed is one parameter", key));
        d.parameters.push_back(std::move(p));
    });
    std::size_t k = 0;
    for_each_table(root, name, [&](const Table& table) { try_values(table, d.parameters[k++], base, kinds); });
    return std::move(d.parameters);
}

Description parse(std::string_view text, std::string_view source_name) {
    constexpr std::int64_t int64_max = std::numeric_limits<std::int64_t>::max();
    const toml::table document = parse_document(text, source_name);
    const Table root{source_name, "description", document};
    root.allow_only({"sweep", "base", "motion_checksums", "parameter", "metric"});
    if (!root.node("sweep").is_table()) root.fail(root.node("sweep"), "sweep is a section: write [sweep] once");
    const Table sweep{source_name, "sweep", *root.node("sweep").as_table()};
    sweep.allow_only({"gyros", "seed", "duration_s", "sobol_shift", "sensitivity"});
    Description d;
    if (sweep.has("seed")) d.seed = static_cast<std::uint64_t>(sweep.integer("seed", 0, int64_max));
    d.duration_s = sweep.optional_real("duration_s");
    if (d.duration_s) {
        config::Config scratch;
        config::apply_pair(
            scratch, "run.duration_s", text::toml_real(*d.duration_s),
            fmt::format("{}:{}: [sweep] duration_s", source_name, sweep.node("duration_s").source().begin.line));
    }
    d.sobol_shift = sweep.boolean("sobol_shift", d.sobol_shift);
    // A former version wrote it into each file of results.
    if (sweep.boolean("sensitivity", false))
        sweep.refuse("sensitivity",
                     "false: a design of Saltelli's is drawn from lists, and its indices are those of SALib");
    read_base(root, source_name, d);
    read_motion_checksums(root, source_name, d);
    d.parameters = read_parameters(root, "parameter", base_config(d, source_name));
    read_metrics(root, d);
    read_gyros(sweep, d);
    return d;
}

}  // namespace zlg::sweep
