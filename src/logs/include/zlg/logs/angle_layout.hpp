#pragma once
// What stands in an angle log: its columns, what is above its rows, and how it is written.

#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/row_rules.hpp>
#include <zlg/logs/settings.hpp>
#include <zlg/logs/table_column.hpp>

namespace zlg::logs {

// Among its settings the legend of the flags, `flags`, and `tick_s`.
struct AngleHeader : LogHeader {
    bool has_truth = false;  // /truth/dtheta_arcsec
};

// A row and the time at which its tick ends.
struct TimedAngle {
    core::AngleRow row;  // relock_arcsec is not in the log and stays 0
    double t_s = 0.0;
    double truth_dtheta_arcsec = std::numeric_limits<double>::quiet_NaN();  // what the twin turned; NaN: not in the log
};

struct AngleWriterOptions {
    bool has_truth = false;  // HDF5: the column /truth/dtheta_arcsec; a CSV log has none
    // HDF5: destroyed before `close`, PATH.part stays, not complete, with all rows so far; without a row it goes.
    bool keep_part = false;
    bool keep_csv_part = false;                           // the same of CSV, for what cannot be had again
    bool has_fingerprint = false;                         // room for one, which `set_fingerprint` fills
    FormatVersion format_version = logs::format_version;  // of a copy that of its source
};

// A member of the row of a tick, from a TimedAngle.
template <class Member> constexpr auto of_row(Member core::AngleRow::*member) {
    return [member](auto& angle) -> auto& { return angle.row.*member; };
}

// All columns of an angle log but the truth, in the order of a CSV log.
struct AngleTable {
    using Row = TimedAngle;
    using Header = AngleHeader;
    struct Presence {};  // every column is required

    static constexpr const char* group = "/angles";  // of an HDF5 log

    using Tick = core::AngleRow;

    static constexpr std::tuple columns{
        required_column<std::int64_t>("tick", "1", of_row(&Tick::tick), RowNumber{}),
        required_column<double>("t_s", "s", &Row::t_s, Real{}),
        required_column<double>("dtheta_arcsec", "arcsec", of_row(&Tick::dtheta_arcsec), Real{}),
        required_column<double>("dtheta_final_arcsec", "arcsec", of_row(&Tick::dtheta_final_arcsec), Real{}),
        required_column<double>("sigma_arcsec", "arcsec", of_row(&Tick::sigma_arcsec), Deviation{}),
        required_column<std::int8_t>("mode", "1", of_row(&Tick::mode), Sign{}),
        required_column<std::uint32_t>("flags", "1", of_row(&Tick::flags), any_whole<std::uint32_t>),
    };
};

}  // namespace zlg::logs
