#include <zlg/sweep/description.hpp>

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include <zlg/text/toml_text.hpp>
#include <zlg/text/whole_file.hpp>

namespace zlg::sweep {
namespace {

std::string list_text(const std::vector<Value>& values) {
    std::vector<std::string> texts;
    for (const Value& value : values) texts.push_back(toml_of(value));
    return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string text_of(const Parameter& p) {
    std::vector<std::string> keys;
    for (const std::string& key : p.keys) keys.push_back(text::toml_string(key));
    std::string text =
        fmt::format("[[parameter]]\nkeys = [{}]\ndraw = \"{}\"\n", fmt::join(keys, ", "), name_of(p.draw));
    if (has_values(p.draw)) text += fmt::format("values = {}\n", list_text(p.values));
    if (has_range(p.draw)) text += fmt::format("min = {}\nmax = {}\n", text::toml_real(p.min), text::toml_real(p.max));
    if (has_mean(p.draw)) text += fmt::format("mean = {}\nsd = {}\n", text::toml_real(p.mean), text::toml_real(p.sd));
    return text;
}

std::string text_of(const Metric& metric) {
    std::string text = fmt::format("[[metric]]\nname = {}\n", text::toml_string(metric.name));
    if (metric.min) text += fmt::format("min = {}\n", text::toml_real(*metric.min));
    if (metric.max) text += fmt::format("max = {}\n", text::toml_real(*metric.max));
    return text;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in{text};
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

// What decides the rows, with the version of the program in the first line.
std::vector<std::string> deciding_lines(const std::string& toml) {
    Description d = parse(toml, "description");
    for (Metric& metric : d.metrics) metric.min = metric.max = std::nullopt;
    if (may_grow(d)) d.n_gyros = 1;
    std::vector<std::string> lines = lines_of(to_toml(d));
    lines.front() = toml.substr(0, toml.find('\n'));
    return lines;
}

// The head of a table says nothing without the name in the line below it.
std::string shown(const std::vector<std::string>& lines, std::size_t k) {
    if (k >= lines.size()) return "nothing more";
    return lines[k].starts_with("[[") && k + 1 < lines.size() ? fmt::format("`{} {}`", lines[k], lines[k + 1])
                                                              : fmt::format("`{}`", lines[k]);
}

std::string difference_of(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    if (x == a.end() && y == b.end()) return {};
    const auto k = static_cast<std::size_t>(x - a.begin());
    return fmt::format("has {}, this one {}", shown(a, k), shown(b, k));
}

}  // namespace

std::string toml_of(const Value& value) {
    const double* number = std::get_if<double>(&value);
    return number != nullptr ? text::toml_real(*number) : std::get<std::string>(value);
}

std::string to_toml(const Description& d) {
    std::string text = fmt::format("# zlg {}\n[sweep]\ngyros = {}\nseed = {}\n", ZLG_VERSION, d.n_gyros, d.seed);
    if (d.duration_s) text += fmt::format("duration_s = {}\n", text::toml_real(*d.duration_s));
    text += fmt::format("sobol_shift = {}\n[base]\n", d.sobol_shift);
    for (const auto& [key, value] : d.base) text += fmt::format("{} = {}\n", key, value);
    if (!d.motion_checksums.empty()) text += "[motion_checksums]\n";
    for (const auto& [path, checksum] : d.motion_checksums)
        text += fmt::format("{} = {}\n", text::toml_string(path), text::toml_string(checksum));
    for (const Parameter& p : d.parameters) text += text_of(p);
    for (const Metric& metric : d.metrics) text += text_of(metric);
    return text;
}

Description read_description(const std::string& path) {
    try {
        return parse(text::read_whole(path), path);
    } catch (const text::CannotRead& error) {
        throw config::ConfigError(fmt::format("cannot read the description {}: {}", path, error.what()));
    }
}

config::Config base_config(const Description& description, std::string_view source_name) {
    config::Config config;
    for (const auto& [key, value] : description.base) config::apply_pair(config, key, value, source_name);
    if (description.duration_s)
        config::apply_pair(config, "run.duration_s", text::toml_real(*description.duration_s), "sweep.duration_s");
    return config;
}

bool may_grow(const Description& description) {
    return std::ranges::none_of(description.parameters, [](const Parameter& p) {
        return p.draw == DrawKind::grid || p.draw == DrawKind::latin;
    });
}

std::int64_t grid_points(const Description& description) {
    std::int64_t n = 1;
    for (const Parameter& p : description.parameters)
        if (p.draw == DrawKind::grid) n = std::min(n * static_cast<std::int64_t>(p.values.size()), max_gyros + 1);
    return n;
}

std::string difference(const std::string& theirs, const std::string& ours) {
    return difference_of(deciding_lines(theirs), deciding_lines(ours));
}

std::string first_difference(const std::string& theirs, const std::string& ours) {
    return difference_of(lines_of(theirs), lines_of(ours));
}

}  // namespace zlg::sweep
