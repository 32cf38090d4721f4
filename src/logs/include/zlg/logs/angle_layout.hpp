#pragma once
// What stands in an angle log: its rows, what is above them, and how it is written.

#include <limits>
#include <string>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/settings.hpp>

namespace zlg::logs {

struct AngleHeader {
    // `# key = value` or /config, in their order; with the legend of the flags, `flags`, and `tick_s`.
    Settings settings;
    std::vector<std::string> warnings;  // unknown columns that are ignored, one line each
    bool has_truth = false;             // /truth/dtheta_arcsec
    bool complete = true;               // false: an HDF5 log that is being written, or whose writer was interrupted
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
    bool keep_csv_part = false;  // the same of CSV, for what cannot be had again
};

}  // namespace zlg::logs
