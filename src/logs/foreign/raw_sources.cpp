#include "raw_sources.hpp"
#include "row_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <zlg/logs/error.hpp>

#include "celsius.hpp"
#include "suspect_values.hpp"

namespace zlg::logs {

RawSources::RawSources(const ForeignLook& look) : look_{look} {
    std::vector<std::int64_t> wanted;
    for (const std::string& key : raw_keys()) {
        if (!look.mapping.has(key)) continue;
        const std::string said = look.mapping.text(key);
        RawSource source{.key = key, .values = {}, .from = said};
        source.fixed = fixed_value(said).value_or(missing);
        source.alternates = said.starts_with("alternating:");
        if (std::isnan(source.fixed)) wanted.push_back(column_named(look.table, said).number);
        all_.push_back(std::move(source));
    }
    if (wanted.empty() || fixed_value(look.mapping.text("counts")))
        throw MappingError(
            fmt::format("{}: counts = '{}'; allowed is a column", look.table.path, look.mapping.text("counts")));
    read_ = look.table.read(wanted, time_column(look.table, look.mapping));
    take_out_missing(look.mapping, read_);
    notes_ = settle_times(read_);
    for (const TextColumn& column : read_.columns) refuse_missing_marks(look.table.path, column);
    n_ = read_.columns.front().values.size();
    std::size_t next = 0;
    for (RawSource& source : all_) {
        if (std::isnan(source.fixed)) {
            source.from = described(read_.columns[next]);
            if (source.key == "temperature_c")
                if (const std::string note = make_celsius(read_.columns[next]); !note.empty()) notes_.push_back(note);
            source.values = std::move(read_.columns[next++].values);
        }
        if (source.key != "mode" && source.key != "bias_sign") continue;
        if (source.values.empty() && std::fabs(source.fixed) != 1.0)
            throw MappingError(
                fmt::format("{}: {} = '{}'; allowed are 1 and -1", look.table.path, source.key, source.from));
        make_signs(source.values, look.mapping.real(source.key + "_plus"),
                   fmt::format("{}, {}", look.table.path, source.from), source.key);
    }
    refuse_empty_states();
    refuse_other_counts();
}

// A state that a row with counts does not say is not that of the row before.
void RawSources::refuse_empty_states() const {
    for (const char* key : {"bias_sign", "mode", "loop_closed", "loop_open", "valid"}) {
        if (!is_column(key)) continue;
        for (std::size_t k = 0; k < n_; ++k)
            if (std::isnan(at(key, k)) && !std::isnan(at("counts", k))) refuse(key, k, "a number beside counts");
    }
}

// Halves of both signs count both ways about the bias, unless the counter keeps adding or has lost the direction.
void RawSources::refuse_other_counts() const {
    const LongColumn& counts = find("counts")->values;
    constexpr std::size_t enough = 16;
    double sign = 0.0;
    std::size_t n = 0;
    bool has_plus = false, has_minus = false, rises = true;
    double last = missing;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        if (std::isnan(counts[k])) continue;
        if (at("bias_sign", k) > 0.0) has_plus = true;
        if (at("bias_sign", k) < 0.0) has_minus = true;
        rises = rises && !(counts[k] < last);
        last = counts[k];
        if (counts[k] == 0.0) continue;
        if (sign * counts[k] < 0.0) return;
        sign = counts[k];
        ++n;
    }
    if (n < enough || !has_plus || !has_minus) return;
    throw FormatError(fmt::format(
        "{}, {}: the counts {}, while the bias alternates; allowed are counts of the row alone, with their direction",
        look_.table.path, find("counts")->from, rises ? "only rise, as a running total does" : "all have one sign"));
}

const RawSource* RawSources::find(std::string_view key) const {
    const auto found = std::ranges::find(all_, key, &RawSource::key);
    return found == all_.end() ? nullptr : &*found;
}

double RawSources::at(std::string_view key, std::size_t k) const {
    const RawSource* source = find(key);
    if (source == nullptr) return missing;
    if (!source->values.empty()) return source->values[k];
    return source->alternates && k % 2 != 0 ? -source->fixed : source->fixed;
}

void RawSources::fill(const RowTimes& times) {
    for (RawSource& source : all_) fill_holes(source.values, times);
    n_ += static_cast<std::size_t>(times.n_missing);
    holes_ = times.holes;
}

std::size_t RawSources::row_of_file(std::size_t k) const {
    std::size_t filled = 0;
    for (const Hole& hole : holes_) {
        if (k <= hole.row + filled) break;
        filled += std::min(static_cast<std::size_t>(hole.n_missing), k - hole.row - filled);
    }
    return k - filled + 1;
}

void RawSources::refuse(std::string_view key, std::size_t k, const std::string& allowed) const {
    const RawSource* source = find(key);
    throw FormatError(fmt::format("{}, {}, row {}: {} = {}; allowed is {}", look_.table.path, source->from,
                                  row_of_file(k), key, at(key, k), allowed));
}

void make_signs(LongColumn& values, std::optional<double> plus, const std::string& where, const std::string& key) {
    double other = missing;
    std::size_t row = 0;
    values.change([&](double value) {
        ++row;
        if (std::isnan(value)) return value;
        if (!plus) {
            if (std::fabs(value) == 1.0) return value;
            throw MappingError(
                fmt::format("{}, row {}: {}; allowed are +1 and -1, or --map {}_plus=... the value that stands for +1",
                            where, row, value, key));
        }
        if (value != *plus && std::isnan(other)) other = value;
        if (value != *plus && value != other)
            throw FormatError(
                fmt::format("{}, row {}: {} = {}; allowed is {} or {}", where, row, key, value, *plus, other));
        return value == *plus ? 1.0 : -1.0;
    });
}

}  // namespace zlg::logs
