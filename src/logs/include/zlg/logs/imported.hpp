#pragma once
// Rows of our own logs from a file of another program.
//
// What the file itself says is taken and said; what it leaves open is asked for. Nothing that a number depends on is
// guessed.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/foreign_table.hpp>
#include <zlg/logs/long_column.hpp>
#include <zlg/logs/mapping.hpp>
#include <zlg/logs/raw_layout.hpp>
#include <zlg/logs/row_times.hpp>

namespace zlg::logs {

enum class Makes { raw, axes };

struct ForeignLook {
    ForeignTable table;
    Mapping mapping;                   // what was said, and what the file says of itself
    Makes makes = Makes::axes;         // raw: there is a column of counts; else angles or rates of axes
    std::vector<std::string> said;     // what was understood, a line each
    std::vector<std::string> missing;  // "unit=deg/s, ..., of 'wz'": what must be given before rows are made
    std::vector<std::string> may_be;   // of each column
};

// errors  as foreign_table(); MappingError: a column that is said is not there.
[[nodiscard]] ForeignLook look_at_foreign(const std::string& path, const Mapping& said);

// The same of files of one record, in their order: rows that are missing between them are as those within one.
//
// errors  as above; MappingError: they have not the same columns.
[[nodiscard]] ForeignLook look_at_foreign(const std::vector<std::string>& paths, const Mapping& said);

// errors  MappingError: one line with all that is missing.
void require_whole(const ForeignLook& look);

struct ImportedRaw {
    RawHeader header;  // with tick_s and scale_arcsec among its settings
    std::vector<core::HalfRecord> rows;
    std::vector<std::string> notes;
    std::vector<std::string> warnings;  // of the times, a line each
};

// Half-periods: rows that are missing by the times or the numbers of the halves become halves with `valid` 0.
//
// errors  MappingError: something is missing or contradicts the file; FormatError: a value that a raw log cannot hold,
// times that do not say where rows are missing, rows that do not make halves exactly; the reason is in the line.
[[nodiscard]] ImportedRaw imported_raw(const ForeignLook& look);

struct ImportedAxis {
    std::string name;
    std::string holds;  // "rates, deg/s"
    double rate_hz = 0.0;
    LongColumn rates_arcsec_s;          // NaN where nothing was measured
    LongColumn phase_arcsec;            // where angles are recorded: those, one more
    std::vector<std::int8_t> mode;      // of a switched gyro, as many as rates; else empty
    std::vector<std::string> warnings;  // values that may be no measurements, a line each
};

struct ImportedAxes {
    std::vector<ImportedAxis> axes;
    std::vector<double> table_rates_arcsec_s;  // of a rate table that turned the gyro; NaN: not known; else empty
    std::vector<double> temperature_c;         // as many as rates of an axis; where no column is said to hold it empty
    std::vector<std::string> notes;
};

// errors  as imported_raw().
[[nodiscard]] ImportedAxes imported_axes(const ForeignLook& look);

// The numbers of one column as they stand in the file: of the axis that the mapping says, or of the first column, if
// that does not rise as times do. The mapping says rate_hz, and the times of the rows agree with it.
//
// errors  as imported_axes(); FormatError: rows are missing.
[[nodiscard]] TextColumn even_column(const ForeignTable& table, const Mapping& mapping);

// The angle log of one axis: a row a sample, sigma_arcsec unknown (inf). A missing sample is flagged `invalid` and
// `unrepaired` and turns by nothing; where angles were recorded the turn over missing ones is spread evenly and flagged
// `interpolated` in place of `unrepaired`.
//
// take    each row in turn.
// return  how many there are.
std::int64_t angle_rows(const ImportedAxis& axis, const std::function<void(const core::AngleRow&)>& take);

// Of the rows that jump away by a hundred usual steps and come back at once, a line; empty: there are none.
//
// values  NaN where nothing was measured.
// what    they are, for the line: "column 2".
[[nodiscard]] std::string spikes(std::span<const double> values, const std::string& what);

}  // namespace zlg::logs
