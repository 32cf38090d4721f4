#pragma once
// The angle log: one row per tick, as CSV.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/table_file.hpp>

namespace zlg::logs {

struct AngleHeader {
    std::vector<std::pair<std::string, std::string>>
        settings;                       // lines `# key = value`, the legend of the flags included
    std::vector<std::string> warnings;  // unknown columns that are ignored, one line each
};

// A row and the time at which its tick ends.
struct TimedAngle {
    core::AngleRow row;  // relock_arcsec is not in the log and stays 0
    double t_s = 0.0;
};

// Reads rows in order and checks every one: tick without holes from 0, finite numbers, sigma 0 or more or inf, mode
// +1/-1.
class AngleReader {
public:
    // errors  IoError, FormatError (an empty file, no header, a missing or misspelt column).
    explicit AngleReader(const std::string& path);
    ~AngleReader();
    AngleReader(AngleReader&&) noexcept;

    [[nodiscard]] const AngleHeader& header() const;

    // The next row; false at the end. errors FormatError: path, line, column, value, what is allowed.
    bool next(TimedAngle& angle);

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Columns tick,t_s,dtheta_arcsec,dtheta_final_arcsec,sigma_arcsec,mode,flags; reals in the shortest form that reads
// back.
//
// The file appears under its name at `close`, whole, or not at all.
class AngleWriter {
public:
    // errors  IoError, FormatError (a setting with a line break).
    AngleWriter(const std::string& path, double tick_s,
                const std::vector<std::pair<std::string, std::string>>& settings, bool force);

    // errors  IoError; FormatError: an angle that is not finite, a sigma that is negative or NaN.
    void write(const core::AngleRow& row);
    void close();

private:
    TableFile file_;
    double tick_s_;
};

}  // namespace zlg::logs
