#pragma once
// The raw log: one row per half-period, as CSV or HDF5.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/raw_layout.hpp>

namespace zlg::logs {

class RawSource;
class RawSink;

// Reads rows in order and checks every one: half without holes from 0, bias_sign +1/-1 and alternating, mode +1/-1,
// integer counts of magnitude at most 2^52, loop_closed and valid 0/1, finite numbers, detunings of at most 30 wavelengths, mean
// squares of them that are 0 (not known) or no less than the square of the mean, edge offsets of 32 bits, a span of no
// more than the row itself and the rows of valid 0, counts 0 and span 1 directly before it. Absent optional columns: NaN,
// valid 1, edge offset 0, span 1. The format is recognised by the content.
class RawReader {
public:
    // An HDF5 log may be open in a writer, or left behind by one that was killed: its whole rows are there.
    //
    // errors  IoError, FormatError (an empty file, no header, a missing or misspelt column, one of a wrong kind, edge
    // offsets without timer_hz).
    explicit RawReader(const std::string& path);
    ~RawReader();
    RawReader(RawReader&&) noexcept;

    [[nodiscard]] const RawHeader& header() const;

    // The next row; false at the end. errors FormatError: path, line or row, column, value, what is allowed.
    bool next(core::HalfRecord& record);

    // The light samples of the row that was read last, until the next call; empty where the log has none.
    [[nodiscard]] core::LightSamples light() const;

    // Looks for rows that have been written since; true: `next` has more. Also renews header().complete.
    bool refresh();

    // False where the row that was read last is the file's last line and has no end: it may have been cut off.
    [[nodiscard]] bool line_is_ended() const;

    // Of the file, 0..1, a buffer ahead of the rows.
    [[nodiscard]] double fraction_read() const;

private:
    std::unique_ptr<RawSource> source_;
};

// Writes a raw log with the required and the given columns, in the format that the suffix says: .csv, .h5 or .hdf5.
//
// It appears under its name at `close`, whole, or not at all. As HDF5 it grows as PATH.part, which can be read meanwhile
// and after a crash, up to the last `flush`; every 16384 rows are flushed by themselves.
class RawWriter {
public:
    // errors  IoError (another suffix included), FormatError (a setting with a line break, light samples in a CSV log, edge
    // offsets without timer_hz).
    RawWriter(const std::string& path, const Settings& settings, bool force,
              const RawColumns& columns = all_raw_columns, const RawWriterOptions& options = {});
    ~RawWriter();
    RawWriter(RawWriter&&) noexcept;

    // errors  IoError; FormatError: a number of a column that is not finite, which no reader would accept; a shifted edge
    // or a span without the column for it; another number of light samples than announced.
    void write(const core::HalfRecord& record, const core::LightSamples& light = {});

    // Makes all rows so far visible to readers of PATH.part. errors  IoError.
    void flush();
    void close();

    [[nodiscard]] const std::string& part_path() const;

private:
    std::unique_ptr<RawSink> sink_;
};

}  // namespace zlg::logs
