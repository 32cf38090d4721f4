#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <zlg/logs/error.hpp>
#include <zlg/logs/imported.hpp>

#include "raw_sources.hpp"
#include "row_clock.hpp"

namespace zlg::logs {

namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

// How many rows make a half, and the row at which the first whole half begins.
struct Halves {
    std::size_t rows = 1;
    std::size_t begin = 0;
};

[[noreturn]] void refuse_whole_ticks(const std::string& path) {
    throw FormatError(
        fmt::format("{}: its rows are not halves of a bias period, and counts of a whole one cannot be parted into "
                    "halves; as an angle: --map axis=COLUMN --map holds=increment --map unit=counts, without "
                    "counts",
                    path));
}

// By the signs of the bias: a half ends where they turn. Rows that are missing have none.
Halves halves_by_signs(const RawSources& from, const std::string& path) {
    const LongColumn& sign = from.find("bias_sign")->values;
    std::vector<std::size_t> turns;
    for (std::size_t k = 1; k < sign.size(); ++k)
        if (!std::isnan(sign[k]) && !std::isnan(sign[k - 1]) && sign[k] != sign[k - 1]) turns.push_back(k);
    if (turns.empty()) refuse_whole_ticks(path);
    std::vector<std::size_t> lengths;
    for (std::size_t k = 1; k < turns.size(); ++k) lengths.push_back(turns[k] - turns[k - 1]);
    if (lengths.empty()) lengths = {1};
    const auto middle = lengths.begin() + std::ssize(lengths) / 2;
    std::nth_element(lengths.begin(), middle, lengths.end());
    const Halves halves{.rows = *middle, .begin = turns.front() % *middle};
    const double first = sign[turns.front()];
    const std::size_t parity = (turns.front() - halves.begin) / halves.rows % 2;
    for (std::size_t k = 0; k < sign.size(); ++k) {
        const std::size_t half = (k + halves.rows - halves.begin) / halves.rows + 1;
        const double due = (half + parity) % 2 == 0 ? first : -first;
        if (std::isnan(sign[k]) || sign[k] == due) continue;
        throw FormatError(
            fmt::format("{}, row {}: bias_sign = {:+}; expected {:+}: the signs turn every {} row{} elsewhere, so that "
                        "a row is missing or "
                        "stands twice before this one, and no column of times or numbers of halves says which",
                        path, from.row_of_file(k), sign[k], due, halves.rows, halves.rows == 1 ? "" : "s"));
    }
    return halves;
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
        find_halves();
        settle_tick();
        if (!from_.is_column("half") && !from_.read().times)
            made_.notes.push_back("nothing in it says whether rows are missing: neither times nor numbers of halves");
        if (halves_.begin > 0)
            made_.notes.push_back(fmt::format("the first {} row{} a half that began before the file, and left out",
                                              halves_.begin, halves_.begin == 1 ? " is" : "s are"));
        const std::size_t n = (from_.n() - halves_.begin) / halves_.rows;
        const std::size_t rest = (from_.n() - halves_.begin) % halves_.rows;
        if (rest > 0) made_.notes.push_back(fmt::format("the last {} rows are no whole half, and left out", rest));
        made_.rows.reserve(n);
        for (std::size_t h = 0; h < n; ++h) made_.rows.push_back(half_of(h));
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
        is_odd_ = std::fmod(number.front(), 2.0) != 0.0;
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
            // Rows of a half are the usual case; of parts of one the unit must be known.
            if (!missing_of_clock(look_.table, mapping).empty()) step = *tick / 2.0;
        }
        clock_ = row_clock(from_.read(), path_, mapping, step);
        // Numbers of rows show which are missing, and not how long one is.
        knows_step_ = !step || !clock_.times || !numbers_rows(*from_.read().times, *clock_.times);
        std::ranges::copy(clock_.notes, std::back_inserter(made_.notes));
        std::ranges::copy(clock_.warnings, std::back_inserter(made_.warnings));
        if (!holes_count) clock_.times.reset();
    }

    void fill(const RowTimes& times, const char* by) {
        if (times.n_missing > 0)
            made_.notes.push_back(
                fmt::format("{} rows are missing by {}; they become halves with valid 0", times.n_missing, by));
        from_.fill(times);
    }

    void find_halves() {
        if (from_.is_column("half")) {
            halves_.begin = is_odd_ ? 1 : 0;
            return;
        }
        if (from_.is_column("bias_sign")) {
            halves_ = halves_by_signs(from_, path_);
            return;
        }
        // Signs that merely alternate say nothing of how long a row is.
        const auto tick = look_.mapping.real("tick_s");
        if (!tick || !knows_step_) return;
        const double rows = *tick / 2.0 / clock_.step_s;
        if (rows < 0.75) refuse_whole_ticks(path_);
        if (std::fabs(rows - 1.0) > 1e-3)
            throw FormatError(fmt::format(
                "{}: a half of {} s has {:.6g} rows of {:.6g} s, and nothing says where halves begin; allowed "
                "is a column bias_sign",
                path_, *tick / 2.0, rows, clock_.step_s));
    }

    // What is said and what the times say must agree.
    void settle_tick() {
        const auto said = look_.mapping.real("tick_s");
        const double by_times_s = 2.0 * static_cast<double>(halves_.rows) * clock_.step_s;
        if (!said && !knows_step_)
            throw MappingError(
                fmt::format("{}: is missing: --map tick_s=... (the whole bias period, two halves)", path_));
        tick_s_ = said.value_or(by_times_s);
        if (said && knows_step_ && std::fabs(by_times_s / *said - 1.0) > 1e-3)
            throw FormatError(fmt::format(
                "{}: tick_s = {}, and two halves of {} row{} of {:.6g} s make {:.6g} s; allowed is one value{}", path_,
                *said, halves_.rows, halves_.rows == 1 ? "" : "s", clock_.step_s, by_times_s,
                halves_.rows == 1 && std::fabs(by_times_s / *said - 2.0) < 1e-2
                    ? "; counts of whole ticks cannot be parted into halves"
                    : ""));
        if (!said) made_.notes.push_back(fmt::format("tick_s = {} by the times of the rows", tick_s_));
        made_.header.settings = {{"gyro.tick_s", fmt::format("{}", tick_s_)},
                                 {"gyro.scale_arcsec", look_.mapping.text("scale_arcsec")}};
        if (halves_.rows > 1)
            made_.notes.push_back(fmt::format("{} rows make a half; their counts are added up", halves_.rows));
        for (const char* key : {"fringe", "span", "edge_offset_ticks"})
            if (halves_.rows > 1 && from_.find(key) != nullptr)
                throw FormatError(
                    fmt::format("{}: {} rows make a half, and {} of a part of one is none of the half; leave it out",
                                path_, halves_.rows, key));
    }

    [[nodiscard]] double whole(const char* key, std::size_t k, double min, double max) const {
        const double value = from_.at(key, k);
        if (!(value == std::floor(value) && value >= min && value <= max))
            from_.refuse(key, k, fmt::format("a whole number from {} to {}", min, max));
        return value;
    }

    [[nodiscard]] bool flag(const char* key, std::size_t k) const { return whole(key, k, 0.0, 1.0) != 0.0; }

    core::HalfRecord half_of(std::size_t h) {
        const auto half = static_cast<std::int64_t>(h);
        core::HalfRecord row;
        row.half = half;
        const std::size_t from = halves_.begin + h * halves_.rows;
        bool is_there = true;
        double counts = 0.0;
        for (std::size_t k = from; k < from + halves_.rows; ++k) {
            const double n = from_.at("counts", k);
            is_there = is_there && !std::isnan(n);
            if (std::isnan(n)) continue;
            counts += whole("counts", k, -4503599627370496.0, 4503599627370496.0);
            if (from_.find("valid") != nullptr && !flag("valid", k)) row.valid = false;
        }
        take_signs(row, from, half);
        take_loop(row, from);
        row.valid = row.valid && is_there;
        row.counts = is_there ? static_cast<std::int64_t>(counts) : 0;
        take_rest(row, from, half);
        last_ = row;
        return row;
    }

    void take_signs(core::HalfRecord& row, std::size_t from, std::int64_t half) const {
        double sign = missing, mode = missing;
        for (std::size_t k = from; k < from + halves_.rows; ++k) {
            const double s = from_.at("bias_sign", k), m = from_.at("mode", k);
            if (!std::isnan(s)) sign = s;
            if (std::isnan(m)) continue;
            if (!std::isnan(mode) && m != mode) from_.refuse("mode", k, "one value throughout a half");
            mode = m;
        }
        // Before the first known sign nothing is known of it; a log must say one.
        if (std::isnan(sign)) sign = half == 0 ? 1.0 : -last_.bias_sign;
        row.bias_sign = sign > 0.0 ? 1 : -1;
        row.mode = std::isnan(mode) ? last_.mode : static_cast<std::int8_t>(mode > 0.0 ? 1 : -1);
    }

    void take_loop(core::HalfRecord& row, std::size_t from) const {
        const bool by_open = from_.find("loop_open") != nullptr;
        const char* key = by_open ? "loop_open" : "loop_closed";
        bool closed = true, known = false;
        for (std::size_t k = from; k < from + halves_.rows; ++k) {
            if (std::isnan(from_.at(key, k))) continue;
            known = true;
            closed = closed && flag(key, k) != by_open;
        }
        row.loop_closed = known ? closed : last_.loop_closed;
    }

    [[nodiscard]] double mean(const char* key, std::size_t from) const {
        double sum = 0.0;
        for (std::size_t k = from; k < from + halves_.rows; ++k) sum += from_.at(key, k);
        return sum / static_cast<double>(halves_.rows);
    }

    void take_rest(core::HalfRecord& row, std::size_t from, std::int64_t half) const {
        const std::size_t end = from + halves_.rows - 1;
        const bool is_there = !std::isnan(from_.at("counts", end));
        // Of a row that is missing: what a log says of a half that was not measured.
        const double detuning = mean("detuning_lambda", from), square = mean("detuning_sq_lambda2", from);
        row.detuning_lambda = from_.find("detuning_lambda") != nullptr && std::isnan(detuning) ? 0.0 : detuning;
        row.detuning_sq_lambda2 = from_.find("detuning_sq_lambda2") != nullptr && std::isnan(square) ? 0.0 : square;
        const double piezo = from_.at("piezo_v", end), temperature = from_.at("temperature_c", end);
        row.piezo_v = std::isnan(piezo) ? (half == 0 ? 0.0 : last_.piezo_v) : piezo;
        row.temperature_c = std::isnan(temperature) ? last_.temperature_c : temperature;
        if (from_.find("temperature_c") != nullptr && std::isnan(row.temperature_c))
            from_.refuse("temperature_c", end, "a finite number in the first row");
        if (from_.find("piezo_v") == nullptr) row.piezo_v = missing;
        if (!is_there) return;
        if (from_.find("fringe") != nullptr) {
            const double fringe = from_.at("fringe", end);
            row.fringe = std::isnan(fringe) ? row.fringe : static_cast<float>(whole("fringe", end, 0.0, 65535.0));
        }
        if (from_.find("span") != nullptr) row.span = static_cast<std::int32_t>(whole("span", end, 1.0, 2147483647.0));
        if (from_.find("edge_offset_ticks") != nullptr)
            row.edge_offset_ticks =
                static_cast<std::int32_t>(whole("edge_offset_ticks", end, -2147483647.0, 2147483647.0));
        if (from_.find("lit") == nullptr) return;
        row.lit = true;
        for (std::size_t k = from; k <= end; ++k) row.lit = row.lit && flag("lit", k);
    }

    void note_columns() {
        RawHeader& header = made_.header;
        header.has_valid = true;
        header.has_detuning = from_.find("detuning_lambda") != nullptr;
        header.has_detuning_sq = from_.find("detuning_sq_lambda2") != nullptr;
        header.has_piezo = from_.find("piezo_v") != nullptr;
        header.has_temperature = from_.find("temperature_c") != nullptr;
        header.has_fringe = from_.find("fringe") != nullptr;
        header.has_span = from_.find("span") != nullptr;
        header.has_lit = from_.find("lit") != nullptr;
        header.has_edge_offset = from_.find("edge_offset_ticks") != nullptr;
        if (header.has_edge_offset) header.timer_hz = look_.mapping.real("timer_hz").value();
    }

    const ForeignLook& look_;
    const std::string& path_;
    RawSources from_;
    ImportedRaw& made_;
    RowClock clock_;
    Halves halves_;
    core::HalfRecord last_{.temperature_c = missing};
    double tick_s_ = 0.0;
    bool is_odd_ = false;
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
