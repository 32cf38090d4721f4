#include <zlg/sweep/gyros.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include <zlg/design/error.hpp>
#include <zlg/study/resolved.hpp>
#include <zlg/study/run.hpp>
#include <zlg/sweep/metrics.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/toml_text.hpp>

namespace zlg::sweep {
namespace {

// Between the bytes of a letter in UTF-8 nothing is cut.
std::string one_line(const std::string& text) {
    std::string line = text::escaped(text::shortened(text, max_reason - 20));
    if (line.size() > max_reason) line.resize(max_reason);
    while (!line.empty() && (static_cast<unsigned char>(line.back()) & 0xc0u) == 0x80u) line.pop_back();
    return line;
}

bool is_of_switches(std::string_view metric) { return metric.find(".switch_error_") != std::string_view::npos; }

void judge(Row& row, const study::RunResult& result, const std::vector<Metric>& metrics) {
    const auto fail = [&](Status status, const std::string& reason) {
        row.status = status;
        row.reason = one_line(reason);
    };
    if (result.tally.none_succeeded() || (result.tally.withheld > 0 && result.tally.lacks_many()))
        return fail(Status::lost, rig::sentence(result.tally));
    for (std::size_t k = 0; k < metrics.size(); ++k) {
        if (std::isfinite(row.metrics[k])) continue;
        const std::string& name = metrics[k].name;
        if (is_of_switches(name) && result.switches.empty())
            return fail(Status::no_switch, fmt::format("{}: the run has no switch", name));
        if (is_of_switches(name))
            return fail(Status::no_switch, fmt::format("{}: no switch was completed and repaired", name));
        return fail(Status::not_finite, fmt::format("{} is {}", name, row.metrics[k]));
    }
}

// A word of a shell.
std::string quoted(const std::string& word) {
    constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-+=/,:@%";
    if (word.find_first_not_of(plain) == std::string::npos) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string{"'\\''"} : std::string{c};
    return text + "'";
}

}  // namespace

bool are_equal(const Row& a, const Row& b) {
    const auto same_bits = [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y) || (std::isnan(x) && std::isnan(y));
    };
    return a.gyro == b.gyro && a.status == b.status && a.reason == b.reason && a.fingerprint == b.fingerprint &&
           std::ranges::equal(a.metrics, b.metrics, same_bits);
}

Gyros::Gyros(const Description& description)
    : description_{description}, base_{base_config(description)}, draws_{description}, motion_files_{description} {
    for (const Metric& metric : description.metrics) {
        const auto variant = variant_of(metric.name);
        if (variant && std::ranges::find(variants_, *variant) == variants_.end()) variants_.push_back(*variant);
    }
}

config::Config Gyros::config(std::int64_t gyro) const {
    config::Config config = base_;
    const std::vector<Value> values = draws_.values(gyro);
    for (std::size_t k = 0; k < values.size(); ++k)
        for (const std::string& key : description_.parameters[k].keys)
            config::apply_pair(config, key, toml_of(values[k]), "drawn");
    config.run.seed = static_cast<std::uint64_t>(seed(gyro));
    config::check(config);
    return config;
}

Row Gyros::run(std::int64_t gyro, const std::function<bool()>& is_stopped) const {
    Row row{.gyro = gyro};
    row.metrics.assign(description_.metrics.size(), std::numeric_limits<double>::quiet_NaN());
    const auto refuse = [&](const std::exception& error) {
        row.status = Status::refused;
        row.reason = one_line(error.what());
    };
    try {
        study::RunTask task{.config = study::resolved(config(gyro)).config};
        task.variants = variants_;
        task.has_figures = false;
        if (is_stopped)
            task.on_progress = [&](double) {
                if (is_stopped()) throw Stopped{};
            };
        const study::RunResult result = study::run(task);
        row.fingerprint = result.fingerprint;
        for (std::size_t k = 0; k < row.metrics.size(); ++k)
            row.metrics[k] = metric_of(result, description_.metrics[k].name);
        judge(row, result, description_.metrics);
    } catch (const config::ConfigError& error) {
        refuse(error);
    } catch (const design::DesignError& error) {
        refuse(error);
    }
    motion_files_.require_unchanged();
    return row;
}

std::string Gyros::command(std::int64_t gyro) const {
    std::string line = fmt::format("zlg run --seed {}", seed(gyro));
    if (description_.duration_s) line += fmt::format(" --duration {}", text::toml_real(*description_.duration_s));
    const auto set = [&](const std::string& key, const std::string& value) {
        line += fmt::format(" --set {}", quoted(fmt::format("{}={}", key, value)));
    };
    const auto is_drawn = [&](const std::string& key) {
        return std::ranges::any_of(description_.parameters,
                                   [&](const Parameter& p) { return std::ranges::find(p.keys, key) != p.keys.end(); });
    };
    for (const auto& [key, value] : description_.base)
        if (!is_drawn(key)) set(key, value);
    const std::vector<Value> values = draws_.values(gyro);
    for (std::size_t k = 0; k < values.size(); ++k)
        for (const std::string& key : description_.parameters[k].keys) set(key, toml_of(values[k]));
    // Whose halves are leapt over, and there is no log of them.
    if (line.find("gyro.fidelity=\"events\"") != std::string::npos) line += " --logs none";
    return line;
}

}  // namespace zlg::sweep
