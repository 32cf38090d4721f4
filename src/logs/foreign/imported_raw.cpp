#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <zlg/logs/error.hpp>
#include <zlg/logs/imported.hpp>

#include "raw_sources.hpp"
#include "row_clock.hpp"

namespace zlg::logs {

namespace {

[[noreturn]] void refuse_whole_ticks(const std::string& path) {
    throw FormatError(
        fmt::format("{}: its rows are not halves of a bias period, and counts of a whole one cannot be parted into "
                    "halves; as an angle: --map axis=COLUMN --map holds=increment --map unit=counts, without counts",
                    path));
}

// Each row is a half: the signs of the bias turn with every one. Rows that are missing have none.
void check_signs(const RawSources& from, const std::string& path) {
    const LongColumn& sign = from.find("bias_sign")->values;
    double due = missing;
    std::size_t n_turns = 0;
    for (std::size_t k = 1; k < sign.size(); ++k) n_turns += sign[k] * sign[k - 1] < 0.0 ? 1u : 0u;
    if (n_turns == 0) refuse_whole_ticks(path);
    for (std::size_t k = 0; k < sign.size(); ++k, due = -due) {
        if (std::isnan(due)) due = sign[k];
        if (std::isnan(sign[k]) || sign[k] == due) continue;
        throw FormatError(fmt::format(
            "{}, row {}: bias_sign = {:+}; expected {:+}: the signs turn {} times in {} rows; allowed is a row "
            "a half, none missing or twice that no column of times or numbers of halves shows",
            path, from.row_of_file(k), sign[k], due, n_turns, sign.size()));
    }
}

class Builder {
public:
    Builder(const ForeignLook& look, ImportedRaw& made)
        : look_{look}, path_{look.table.path}, from_{look}, made_{made} {}

    void build() {
        made_.notes = from_.notes();
        if (from_.is_column("half"))
            fill_by_numbers();
        else
            fill_by_times();
        if (!from_.is_column("half") && from_.is_column("bias_sign")) check_signs(from_, path_);
        settle_tick();
        if (!from_.is_column("half") && !from_.read().times)
            made_.notes.push_back("nothing in it says whether rows are missing: neither times nor numbers of halves");
        if (begin_ > 0)
            made_.notes.push_back(
                "the first row is the second half of a tick that began before the file, and left out");
        for (std::size_t k = begin_; k < from_.n(); ++k) made_.rows.push_back(half_of(k));
        note_columns();
    }

private:
    void fill_by_numbers() {
        const LongColumn& number = from_.find("half")->values;
        RowTimes times{.step = 1.0, .tolerance = 0.0, .holes = {}, .n_missing = 0};
        for (std::size_t k = 0; k < number.size(); ++k) {
            const bool whole = number[k] == std::floor(number[k]) && std::fabs(number[k]) < 1e15;
            if (!whole || (k > 0 && !(number[k] > number[k - 1])))
                from_.refuse("half", k, "a whole number above that of the row before");
            if (k == 0 || number[k] - number[k - 1] == 1.0) continue;
            times.holes.push_back({k - 1, static_cast<std::int64_t>(number[k] - number[k - 1]) - 1});
            times.n_missing += times.holes.back().n_missing;
        }
        refuse_many_missing(path_, from_.find("half")->from, number, times, "");
        begin_ = std::fmod(number.front(), 2.0) != 0.0 ? 1 : 0;
        if (number.front() != 0.0)
            made_.notes.push_back(fmt::format("the halves are numbered anew: the first was {}", number.front()));
        fill(times, "the numbers of the halves");
        clock_from_times(false);
    }

    void fill_by_times() {
        clock_from_times(true);
        if (clock_.times && clock_.times->n_missing > 0) fill(*clock_.times, "the times of the rows");
    }

    void clock_from_times(bool holes_count) {
        // Without the unit of the times the tick decides, below.
        if (!from_.read().times) {
            const auto rate_hz = look_.mapping.real("rate_hz");
            knows_step_ = rate_hz.has_value();
            if (rate_hz) clock_.step_s = 1.0 / *rate_hz;
            return;
        }
        Mapping mapping = look_.mapping;
        std::optional<double> step;
        const auto tick = mapping.real("tick_s");
        if (tick && !mapping.has("rate_hz")) {
            if (!missing_of_clock(look_.table, mapping).empty()) step = *tick / 2.0;
        }
        clock_ = row_clock(from_.read(), path_, mapping, step);
        // Numbers of rows show which are missing, and not how long one is.
        knows_step_ = !step || !clock_.times || !numbers_rows(*from_.read().times, *clock_.times);
        std::copy(clock_.notes.begin(), clock_.notes.end(), std::back_inserter(made_.notes));
        std::copy(clock_.warnings.begin(), clock_.warnings.end(), std::back_inserter(made_.warnings));
        if (!holes_count) clock_.times.reset();
    }

    void fill(const RowTimes& times, const char* by) {
        if (times.n_missing > 0)
            made_.notes.push_back(
                fmt::format("{} rows are missing by {}; they become halves with valid 0", times.n_missing, by));
        from_.fill(times);
    }

    // What is said and what the times say must agree.
    void settle_tick() {
        const auto said = look_.mapping.real("tick_s");
        const double by_times_s = 2.0 * clock_.step_s;
        if (!said && !knows_step_)
            throw MappingError(
                fmt::format("{}: is missing: --map tick_s=... (the whole bias period, two halves)", path_));
        const double tick_s = said.value_or(by_times_s);
        if (said && knows_step_ && by_times_s > 1.5 * *said) refuse_whole_ticks(path_);
        if (said && knows_step_ && std::fabs(by_times_s / *said - 1.0) > 1e-3)
            throw FormatError(
                fmt::format("{}: tick_s = {}, and two rows of {:.6g} s make {:.6g} s; allowed are rows of a half each, "
                            "with the counts of parts of a half added up",
                            path_, *said, clock_.step_s, by_times_s));
        if (!said) made_.notes.push_back(fmt::format("tick_s = {} by the times of the rows", tick_s));
        made_.header.settings = {{"gyro.tick_s", fmt::format("{}", tick_s)},
                                 {"gyro.scale_arcsec", look_.mapping.text("scale_arcsec")}};
    }

    [[nodiscard]] double whole(const char* key, std::size_t k, double min, double max) const {
        const double value = from_.at(key, k);
        if (!(value == std::floor(value) && value >= min && value <= max))
            from_.refuse(key, k, fmt::format("a whole number from {} to {}", min, max));
        return value;
    }

    [[nodiscard]] bool flag(const char* key, std::size_t k) const { return whole(key, k, 0.0, 1.0) != 0.0; }

    core::HalfRecord half_of(std::size_t k) {
        core::HalfRecord row;
        row.half = static_cast<std::int64_t>(k - begin_);
        const bool is_there = !std::isnan(from_.at("counts", k));
        row.valid = is_there && (from_.find("valid") == nullptr || flag("valid", k));
        if (is_there)
            row.counts = static_cast<std::int64_t>(whole("counts", k, -4503599627370496.0, 4503599627370496.0));
        take_states(row, k);
        take_measured(row, k);
        if (is_there) take_rest(row, k);
        last_ = row;
        return row;
    }

    void take_states(core::HalfRecord& row, std::size_t k) const {
        const double sign = from_.at("bias_sign", k), mode = from_.at("mode", k);
        // Before the first known sign nothing is known of it; a log must say one.
        row.bias_sign = std::isnan(sign) ? static_cast<std::int8_t>(row.half == 0 ? 1 : -last_.bias_sign)
                                         : static_cast<std::int8_t>(sign);
        row.mode = std::isnan(mode) ? last_.mode : static_cast<std::int8_t>(mode);
        const bool by_open = from_.find("loop_open") != nullptr;
        const char* loop = by_open ? "loop_open" : "loop_closed";
        row.loop_closed = std::isnan(from_.at(loop, k)) ? last_.loop_closed : flag(loop, k) != by_open;
    }

    void take_measured(core::HalfRecord& row, std::size_t k) const {
        const auto value_or = [&](const char* key, double unknown) {
            const double value = from_.at(key, k);
            return from_.find(key) != nullptr && std::isnan(value) ? unknown : value;
        };
        // Of a row that is missing: what a log says of a half that was not measured.
        row.detuning_lambda = value_or("detuning_lambda", 0.0);
        row.detuning_sq_lambda2 = value_or("detuning_sq_lambda2", 0.0);
        row.piezo_v = value_or("piezo_v", row.half == 0 ? 0.0 : last_.piezo_v);
        row.temperature_c = value_or("temperature_c", last_.temperature_c);
        if (from_.find("temperature_c") != nullptr && std::isnan(row.temperature_c))
            from_.refuse("temperature_c", k, "a finite number in the first row");
    }

    void take_rest(core::HalfRecord& row, std::size_t k) const {
        constexpr double most = 2147483647.0;
        if (from_.find("fringe") != nullptr && !std::isnan(from_.at("fringe", k)))
            row.fringe = static_cast<float>(whole("fringe", k, 0.0, 65535.0));
        if (from_.find("span") != nullptr) row.span = static_cast<std::int32_t>(whole("span", k, 1.0, most));
        if (from_.find("edge_offset_ticks") != nullptr)
            row.edge_offset_ticks = static_cast<std::int32_t>(whole("edge_offset_ticks", k, -most, most));
        if (from_.find("lit") != nullptr) row.lit = flag("lit", k);
    }

    void note_columns() {
        RawHeader& header = made_.header;
        for_each_column<RawTable>([&]<class Field>(const Field& field, std::size_t) {
            if constexpr (Field::is_optional) header.*field.is_there = from_.find(field.name) != nullptr;
        });
        header.has_valid = true;
        if (header.has_edge_offset) header.timer_hz = look_.mapping.real("timer_hz").value();
    }

    const ForeignLook& look_;
    const std::string& path_;
    RawSources from_;
    ImportedRaw& made_;
    RowClock clock_;
    std::size_t begin_ = 0;  // the first row that is an even half
    core::HalfRecord last_{.temperature_c = missing};
    bool knows_step_ = false;
};

}  // namespace

ImportedRaw imported_raw(const ForeignLook& look) {
    require_whole(look);
    ImportedRaw made;
    Builder{look, made}.build();
    if (made.rows.size() < 2)
        throw FormatError(fmt::format("{}: holds no whole tick, which is two half-periods", look.table.path));
    return made;
}

}  // namespace zlg::logs
