#include "sweep_text.hpp"

#include <array>

#include <fmt/format.h>

#include <zlg/sweep/metrics.hpp>
#include <zlg/sweep/statistics.hpp>
#include <zlg/text/toml_text.hpp>

namespace zlg::cli {
namespace {

using nlohmann::json;

constexpr std::size_t n_shown = 5;  // of the gyros to look at
constexpr std::array status_names{"good", "refused", "lost", "no_switch", "not_finite"};

const char* name_of(sweep::Status status) { return status_names.at(static_cast<std::size_t>(status)); }

json number_json(const std::optional<double>& number) { return number ? json(*number) : json(nullptr); }

json yield_json(const std::optional<sweep::Yield>& yield) { return yield ? json(yield->value) : json(nullptr); }

json interval_json(const std::optional<sweep::Yield>& yield) {
    return yield ? json{yield->low, yield->high} : json(nullptr);
}

json metric_json(const sweep::MetricSummary& m) {
    return {{"unit", sweep::unit_of(m.metric.name)},
            {"mean", number_json(m.mean)},
            {"sd", number_json(m.sd)},
            {"p05", number_json(m.p05)},
            {"p50", number_json(m.p50)},
            {"p95", number_json(m.p95)},
            {"yield", yield_json(m.yield)},
            {"yield_interval", interval_json(m.yield)}};
}

json gyro_json(const sweep::Gyros& gyros, const sweep::Row& row) {
    return {{"gyro", row.gyro},
            {"status", name_of(row.status)},
            {"reason", row.reason},
            {"fingerprint", row.fingerprint},
            {"command", gyros.command(row.gyro)}};
}

std::string number_text(const std::optional<double>& number) { return number ? fmt::format("{:.5g}", *number) : "-"; }

std::string limits_text(const sweep::Metric& metric) {
    std::string text;
    if (metric.min) text += fmt::format(" >= {}", text::toml_real(*metric.min));
    if (metric.max) text += fmt::format(" <= {}", text::toml_real(*metric.max));
    return text;
}

std::string yield_text(const sweep::Yield& y) {
    return fmt::format("{:.2f} % ({} of {}; 95 % interval {:.2f} to {:.2f} %)", 100.0 * y.value, y.passed, y.gyros,
                       100.0 * y.low, 100.0 * y.high);
}

std::string table(const sweep::Summary& summary) {
    std::string text =
        fmt::format("{:<58}{:>11}{:>11}{:>11}{:>11}{:>11}  {}\n", "", "mean", "sd", "5 %", "50 %", "95 %", "unit");
    for (const sweep::MetricSummary& m : summary.metrics)
        text += fmt::format("{:<58}{:>11}{:>11}{:>11}{:>11}{:>11}  {}\n", m.metric.name, number_text(m.mean),
                            number_text(m.sd), number_text(m.p05), number_text(m.p50), number_text(m.p95),
                            sweep::unit_of(m.metric.name));
    return text;
}

std::string yields(const sweep::Summary& summary) {
    std::string text;
    std::size_t n_limited = 0;
    for (const sweep::MetricSummary& m : summary.metrics) {
        if (!m.yield) continue;
        ++n_limited;
        text += fmt::format("yield, {}{}: {}\n", m.metric.name, limits_text(m.metric), yield_text(*m.yield));
    }
    if (n_limited > 1) text += fmt::format("yield, all limits together: {}\n", yield_text(*summary.yield));
    return text;
}

}  // namespace

nlohmann::json sweep_json(const sweep::Gyros& gyros, const sweep::Rows& rows) {
    const sweep::Summary summary = summary_of(gyros.description(), rows);
    json metrics = json::object();
    for (const sweep::MetricSummary& m : summary.metrics) metrics[m.metric.name] = metric_json(m);
    json shown = json::array();
    for (const sweep::Row* row : worst(gyros.description(), rows, n_shown)) shown.push_back(gyro_json(gyros, *row));
    return {{"gyros", summary.gyros},
            {"failed", summary.failed},
            {"metrics", std::move(metrics)},
            {"yield", yield_json(summary.yield)},
            {"yield_interval", interval_json(summary.yield)},
            {"worst", std::move(shown)}};
}

std::string sweep_text(const sweep::Gyros& gyros, const sweep::Rows& rows) {
    const sweep::Summary summary = summary_of(gyros.description(), rows);
    std::string text = fmt::format("{} gyros of {}, {} failed\n\n{}{}", summary.gyros, gyros.description().n_gyros,
                                   summary.failed, table(summary), yields(summary));
    text += "\ngyros to look at: failed, then farthest from the middle of the first metric\n";
    for (const sweep::Row* row : worst(gyros.description(), rows, n_shown)) {
        const std::string why =
            row->status == sweep::Status::good
                ? fmt::format("{} = {:.5g}", gyros.description().metrics.front().name, row->metrics.front())
                : fmt::format("{}: {}", name_of(row->status), row->reason);
        text += fmt::format("  {}, {}\n    {}\n", row->gyro, why, gyros.command(row->gyro));
    }
    return text;
}

}  // namespace zlg::cli
