#pragma once
// The raw log: one row per half-period, as CSV.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/table_file.hpp>

namespace zlg::logs {

// Which of the optional columns there are.
struct RawColumns {
    bool has_valid = false;
    bool has_detuning = false;     // detuning_lambda
    bool has_detuning_sq = false;  // detuning_sq_lambda2
    bool has_piezo = false;
    bool has_temperature = false;
};

inline constexpr RawColumns all_raw_columns{true, true, true, true, true};

// What stands above the rows.
struct RawHeader : RawColumns {
    std::vector<std::pair<std::string, std::string>> settings;  // lines `# key = value`, in their order
    std::vector<std::string> warnings;                          // unknown columns that are ignored, one line each
};

// Reads rows in order and checks every one: half without holes from 0, bias_sign +1/-1 and alternating, mode +1/-1,
// integer counts of magnitude at most 2^52, loop_closed and valid 0/1, finite numbers. Absent optional columns: NaN,
// valid 1.
class RawReader {
public:
    // errors  IoError, FormatError (an empty file, no header, a missing or misspelt column).
    explicit RawReader(const std::string& path);
    ~RawReader();
    RawReader(RawReader&&) noexcept;

    [[nodiscard]] const RawHeader& header() const;

    // The next row; false at the end. errors FormatError: path, line, column, value, what is allowed.
    bool next(core::HalfRecord& record);

    // False where the row that was read last is the file's last line and has no end: it may have been cut off.
    [[nodiscard]] bool line_is_ended() const;

    // Of the file, 0..1, a buffer ahead of the rows.
    [[nodiscard]] double fraction_read() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Writes a raw log with the required and the given columns. It appears under its name at `close`, whole, or not at all.
class RawWriter {
public:
    // errors  IoError, FormatError (a setting with a line break).
    RawWriter(const std::string& path, const std::vector<std::pair<std::string, std::string>>& settings, bool force,
              const RawColumns& columns = all_raw_columns);

    // errors  IoError; FormatError: a number of a column that is not finite, which no reader would accept.
    void write(const core::HalfRecord& record);
    void close();

private:
    TableFile file_;
    RawColumns columns_;
};

}  // namespace zlg::logs
