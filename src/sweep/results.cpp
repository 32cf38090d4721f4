#include <zlg/sweep/results.hpp>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>

#include <fmt/format.h>

#include <zlg/logs/column_file.hpp>
#include <zlg/logs/content_hash.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/sweep/metrics.hpp>
#include <zlg/sweep/row_text.hpp>

namespace zlg::sweep {
namespace {

constexpr std::int64_t format_version = 2;

using logs::FileColumn;

template <class Get> auto column(const Rows& rows, const Get& get) {
    std::vector<decltype(get(rows.begin()->second))> values;
    values.reserve(rows.size());
    for (const auto& [gyro, row] : rows) values.push_back(get(row));
    return values;
}

// What each key was given in each row: reals, or texts where any value that the parameter may give is one.
std::vector<FileColumn> drawn_columns(const Description& description, const Rows& rows,
                                      const std::function<std::vector<Value>(std::int64_t)>& values_of) {
    const std::vector<Parameter>& parameters = description.parameters;
    std::vector<std::vector<double>> reals(parameters.size());
    std::vector<std::vector<std::string>> texts(parameters.size());
    std::vector<bool> is_text;
    for (const Parameter& p : parameters)
        is_text.push_back(std::ranges::any_of(p.values, [](const Value& v) { return v.index() != 0; }));
    for (const auto& [gyro, row] : rows) {
        const std::vector<Value> values = values_of(gyro);
        for (std::size_t k = 0; k < values.size(); ++k)
            is_text[k] ? texts[k].push_back(toml_of(values[k])) : reals[k].push_back(std::get<double>(values[k]));
    }
    std::vector<FileColumn> columns;
    for (std::size_t k = 0; k < parameters.size(); ++k)
        for (const std::string& key : parameters[k].keys) {
            const std::string unit = config::unit_of(key);
            is_text[k] ? columns.push_back({key, unit, texts[k]})
                       : columns.push_back({key, unit.empty() ? "1" : unit, reals[k]});
        }
    return columns;
}

struct Damage {
    const std::string& path;

    [[noreturn]] void operator()(std::size_t row, const std::string& what) const {
        throw logs::FormatError(fmt::format("{}, row {}: {}", path, row + 1, what));
    }
};

// Of the description, and of each row as its line of text: the first 52 bits of the hash, which any program holds as a
// number.
std::int64_t checksum_of(const std::string& description, const Rows& rows) {
    logs::ContentHash hash;
    hash.add(description);
    for (const auto& [gyro, row] : rows) hash.add(fields_of(row));
    return static_cast<std::int64_t>(hash.value() >> 12);
}

bool are_same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// The columns of what was drawn stand there for other programs; they must be what the description draws.
void check_drawn(const logs::ColumnReader& file, const std::string& path, const Results& results,
                 const Description& description) {
    const Draws draws{description};
    const auto values_of = [&](std::int64_t gyro) { return draws.values(gyro); };
    for (const FileColumn& ours : drawn_columns(description, results.rows, values_of)) {
        const auto* numbers = std::get_if<std::vector<double>>(&ours.values);
        const bool is_same = numbers != nullptr
                                 ? are_same_bits(file.reals(ours.name), *numbers)
                                 : file.texts(ours.name) == std::get<std::vector<std::string>>(ours.values);
        if (!is_same)
            throw logs::FormatError(
                fmt::format("{}: the column {} is not what the description draws", path, ours.name));
    }
}

}  // namespace

void write_results(const std::string& path, const Gyros& gyros, const Rows& rows) {
    logs::ColumnFile file{.group = "/gyros"};
    const std::string description = to_toml(gyros.description());
    file.texts = {{"/sweep", description}};
    file.marks = {{"format_version", format_version}, {"checksum", checksum_of(description, rows)}};
    file.columns.push_back({"gyro", "1", column(rows, [](const Row& r) { return r.gyro; })});
    file.columns.push_back({"seed", "1", column(rows, [&](const Row& r) { return gyros.seed(r.gyro); })});
    const auto values_of = [&](std::int64_t gyro) { return gyros.values(gyro); };
    for (FileColumn& drawn : drawn_columns(gyros.description(), rows, values_of))
        file.columns.push_back(std::move(drawn));
    const std::vector<Metric>& metrics = gyros.description().metrics;
    for (std::size_t k = 0; k < metrics.size(); ++k)
        file.columns.push_back({metrics[k].name, unit_of(metrics[k].name), column(rows, [k](const Row& r) {
                                    // One pattern of bits for what is no number.
                                    const double value = r.metrics[k];
                                    return value == value ? value : std::numeric_limits<double>::quiet_NaN();
                                })});
    file.columns.push_back(
        {"status", "1", column(rows, [](const Row& r) { return static_cast<std::int64_t>(r.status); })});
    file.columns.push_back({"reason", "", column(rows, [](const Row& r) { return r.reason; })});
    file.columns.push_back({"fingerprint", "", column(rows, [](const Row& r) { return r.fingerprint; })});
    logs::write_columns(path, file);
}

Results read_results(const std::string& path) {
    const logs::ColumnReader file{path, "/gyros"};
    if (file.mark("format_version") != format_version)
        throw logs::FormatError(
            fmt::format("{}: format_version is {}; allowed is {}", path, file.mark("format_version"), format_version));
    Results results{.description = file.text("/sweep"), .rows = {}};
    const Description description = recorded_description(results.description, path);
    const auto gyros = file.integers("gyro");
    const auto seeds = file.integers("seed");
    const auto status = file.integers("status");
    const auto reasons = file.texts("reason");
    const auto fingerprints = file.texts("fingerprint");
    std::vector<std::vector<double>> metrics;
    for (const Metric& metric : description.metrics) metrics.push_back(file.reals(metric.name));
    const auto is_short = [&](const auto& values) { return values.size() != gyros.size(); };
    if (is_short(seeds) || is_short(status) || is_short(reasons) || is_short(fingerprints) ||
        std::ranges::any_of(metrics, is_short))
        throw logs::FormatError(fmt::format("{}: the columns of /gyros are not of one length", path));
    const Damage damage{path};
    for (std::size_t k = 0; k < gyros.size(); ++k) {
        if (gyros[k] < 0 || gyros[k] >= description.n_gyros || (k > 0 && gyros[k] <= gyros[k - 1]))
            damage(k, fmt::format("gyro is {}; allowed is growth within 0..{}", gyros[k], description.n_gyros - 1));
        if (seeds[k] != gyro_seed(description, gyros[k]))
            damage(k, fmt::format("seed is {}; that of gyro {} is {}", seeds[k], gyros[k],
                                  gyro_seed(description, gyros[k])));
        if (status[k] < 0 || status[k] > static_cast<std::int64_t>(Status::not_finite))
            damage(k, fmt::format("status is {}; allowed is 0..{}", status[k], static_cast<int>(Status::not_finite)));
        Row row{gyros[k], static_cast<Status>(status[k]), reasons[k], fingerprints[k], {}};
        for (const std::vector<double>& values : metrics) row.metrics.push_back(values[k]);
        results.rows.emplace_hint(results.rows.end(), row.gyro, std::move(row));
    }
    if (const std::int64_t checksum = checksum_of(results.description, results.rows); file.mark("checksum") != checksum)
        throw logs::FormatError(fmt::format("{}: is damaged, its checksum is {} and that of its rows {}", path,
                                            file.mark("checksum"), checksum));
    check_drawn(file, path, results, description);
    return results;
}

Description recorded_description(const std::string& text, const std::string& path) {
    try {
        return parse(text, path);
    } catch (const config::ConfigError& error) {
        throw logs::FormatError(
            fmt::format("{}: is damaged, or of another version: its description has {}", path, error.what()));
    }
}

void add_rows(Rows& rows, const Rows& more, const std::string& source) {
    for (const auto& [gyro, row] : more) {
        const auto [at, is_new] = rows.emplace(gyro, row);
        if (!is_new && !are_equal(at->second, row))
            throw logs::FormatError(
                fmt::format("{}: gyro {} differs from the one of the same number in another file", source, gyro));
    }
}

}  // namespace zlg::sweep
