#include <zlg/live/record_book.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/core/compensation/angle.hpp>
#include <zlg/core/health.hpp>

#include "kept_records.hpp"
#include "octave_allan.hpp"

namespace zlg::live {
namespace {

using nlohmann::json;

constexpr std::size_t history_points = 1024;

struct Row {
    Record record;
    double angle_arcsec = 0.0;
};

// What an event is made of, out of the book.
struct Copied {
    Position after;
    bool is_snapshot = false;
    std::optional<double> tick_s;
    std::int64_t first = 0;
    std::vector<Row> rows;
    std::uint32_t flags = 0;
    std::uint32_t health = 0;
    std::optional<GapView> gap;
    std::optional<json> allan;
    std::vector<double> history;
    std::int64_t history_stride = 1;
};

// In the shortest form that reads back; null where JSON has no such number.
void put(fmt::memory_buffer& out, double value) {
    if (std::isfinite(value))
        fmt::format_to(std::back_inserter(out), "{},", value);
    else
        out.append(std::string_view{"null,"});
}

std::string rows_json(const std::vector<Row>& rows) {
    fmt::memory_buffer out;
    for (const auto& [record, angle_arcsec] : rows) {
        const core::AngleRow& angle = record.angle;
        out.push_back('[');
        for (const double value : {angle.dtheta_arcsec, angle.dtheta_final_arcsec, angle.sigma_arcsec}) put(out, value);
        fmt::format_to(std::back_inserter(out), "{},{},", angle.mode, angle.flags);
        for (const double value : {angle_arcsec, record.detuning_lambda, record.piezo_v, record.temperature_c})
            put(out, value);
        fmt::format_to(std::back_inserter(out), "{}],", record.health);
    }
    std::string text{out.data(), out.size()};
    if (!text.empty()) text.pop_back();
    return text;
}

json gap_json(const GapView& gap) {
    json dtheta = json::array();
    json final = json::array();
    for (const core::AngleRow& row : gap.rows) {
        dtheta.push_back(row.dtheta_arcsec);
        final.push_back(row.dtheta_final_arcsec);
    }
    return {{"first", gap.first_row},       {"ticks", gap.n_ticks},        {"shown", gap.shown_row},
            {"mode", gap.rows.back().mode}, {"dtheta", std::move(dtheta)}, {"final", std::move(final)}};
}

// The legend of the flags, by bit; empty where a bit has no name.
std::vector<std::string> flag_names() {
    std::vector<std::string> names{core::angle_flag_names.begin(), core::angle_flag_names.end()};
    names.resize(16);
    for (const char* name : {"lost", "final_lost", "restarted", "outage"}) names.emplace_back(name);
    return names;
}

json history_json(const Copied& copied) {
    json times = json::array();
    for (std::size_t k = 0; k < copied.history.size(); ++k)
        times.push_back(static_cast<double>(static_cast<std::int64_t>(k) * copied.history_stride + 1) * *copied.tick_s);
    return {std::move(times), copied.history};
}

// The rows, the greatest part, are not made by way of a tree.
std::string event_text(const json& head, const Copied& copied) {
    std::string object = head.dump(-1, ' ', true, json::error_handler_t::replace);
    object.pop_back();
    return fmt::format("event: {}\ndata: {},\"rows\":[{}]}}\n\n", copied.is_snapshot ? "snapshot" : "rows", object,
                       rows_json(copied.rows));
}

}  // namespace

struct RecordBook::State {
    std::string source;
    bool tells_health = false;

    mutable std::mutex mutex;
    std::optional<double> tick_s;
    std::vector<Row> rows = std::vector<Row>(kept_rows);  // row k at k % kept_rows
    std::int64_t n_rows = 0;
    bool is_ended = false;
    core::ExactSum angle_arcsec;
    std::uint32_t flags = 0;  // that were ever raised
    std::uint32_t health = 0;
    GapFinder gaps;
    Thinned<double, history_points> history;
    OctaveAllan allan;

    [[nodiscard]] bool is_due(std::int64_t from_row) const;
    [[nodiscard]] Copied copy(Position from) const;
};

// A second has begun since: often enough for a deviation.
bool RecordBook::State::is_due(std::int64_t from_row) const {
    const auto second = [this](std::int64_t row) { return std::floor(static_cast<double>(row) * *tick_s); };
    return second(n_rows) > second(from_row);
}

Copied RecordBook::State::copy(Position from) const {
    const std::scoped_lock lock{mutex};
    Copied copied{.after = {n_rows, is_ended}, .tick_s = tick_s, .flags = flags, .health = health};
    copied.is_snapshot = from.next_row < 0 || from.next_row > n_rows || n_rows - from.next_row > most_rows;
    copied.first = copied.is_snapshot ? std::max<std::int64_t>(0, n_rows - kept_rows) : from.next_row;
    copied.rows.reserve(static_cast<std::size_t>(n_rows - copied.first));
    for (std::int64_t row = copied.first; row < n_rows; ++row)
        copied.rows.push_back(rows[static_cast<std::size_t>(row % kept_rows)]);
    const std::optional<GapView>& gap = gaps.newest();
    if (gap && (copied.is_snapshot || gap->end_row > from.next_row)) copied.gap = gap;
    if (tick_s && (copied.is_snapshot || is_due(from.next_row) || (is_ended && !from.knows_end)))
        copied.allan = allan.points(*tick_s);
    if (copied.is_snapshot) {
        copied.history = history.kept();
        copied.history_stride = history.stride();
    }
    return copied;
}

RecordBook::RecordBook(std::string source, bool tells_health) : state_{std::make_unique<State>()} {
    state_->source = std::move(source);
    state_->tells_health = tells_health;
}

RecordBook::~RecordBook() = default;

void RecordBook::add(const Record& record, double tick_s) {
    State& s = *state_;
    const std::scoped_lock lock{s.mutex};
    if (!s.tick_s) s.tick_s = tick_s;
    s.angle_arcsec.add(record.angle.dtheta_final_arcsec);
    s.rows[static_cast<std::size_t>(s.n_rows % kept_rows)] = {record, s.angle_arcsec.value()};
    s.flags |= record.angle.flags;
    s.health |= record.health;
    s.gaps.take(s.n_rows, record.angle);
    s.history.add(s.angle_arcsec.value());
    s.allan.add(s.angle_arcsec.value());
    ++s.n_rows;
}

void RecordBook::end() {
    const std::scoped_lock lock{state_->mutex};
    state_->is_ended = true;
}

Position RecordBook::position() const {
    const std::scoped_lock lock{state_->mutex};
    return {state_->n_rows, state_->is_ended};
}

Event RecordBook::event(Position from) const {
    const Copied copied = state_->copy(from);
    json head{{"tick_s", copied.tick_s ? json(*copied.tick_s) : json(nullptr)},
              {"first", copied.first},
              {"ended", copied.after.knows_end},
              {"since_start", {{"flags", copied.flags}, {"health", copied.health}}}};
    if (copied.gap) head["gap"] = gap_json(*copied.gap);
    if (copied.allan) head["allan"] = *copied.allan;
    if (copied.is_snapshot) {
        head["source"] = state_->source;
        head["flag_names"] = flag_names();
        head["health_names"] = state_->tells_health ? json(core::health_bit_names) : json::array();
        head["history"] = history_json(copied);
    }
    return {copied.after, event_text(head, copied)};
}

}  // namespace zlg::live
