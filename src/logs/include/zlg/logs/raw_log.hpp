#pragma once
// The raw log: one row per half-period, as CSV or HDF5.

#include <memory>
#include <string>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/raw_layout.hpp>

namespace zlg::logs {

template <class Table> class LogSource;
template <class Table> class LogSink;

// Reads rows in order and checks every one by the rules of RawTable and RawSequence, where also stands what a row holds
// of an optional column that is absent. The format is recognised by the content.
class RawReader {
public:
    // An HDF5 log may be open in a writer, or left behind by one that was killed: its whole rows are there.
    //
    // errors  IoError, FormatError (an empty file, no header, a missing or misspelt column, one of a wrong kind, edge
    // offsets without timer_hz).
    explicit RawReader(const std::string& path);
    // Rows that were made of another program's file, which `path` names in messages.
    RawReader(const std::string& path, RawHeader header, std::vector<core::HalfRecord> rows);
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
    std::unique_ptr<LogSource<RawTable>> source_;
    RawSequence rows_before_;
};

// Writes a raw log with the required and the given columns, in the format that the suffix says: .csv, .h5 or .hdf5.
//
// It appears under its name at `close`, whole, or not at all. As HDF5 it grows as PATH.part, which can be read
// meanwhile and after a crash, up to the last `flush`; every 16384 rows are flushed by themselves.
class RawWriter {
public:
    // errors  IoError (another suffix included), FormatError (a setting with a line break, light samples in a CSV log,
    // edge offsets without timer_hz).
    RawWriter(const std::string& path, const Settings& settings, bool force,
              const RawColumns& columns = all_raw_columns, const RawWriterOptions& options = {});
    ~RawWriter();
    RawWriter(RawWriter&&) noexcept;

    // errors  IoError; FormatError: a real number that no reader would accept; a shifted edge or a span without the
    // column for it; another number of light samples than announced.
    void write(const core::HalfRecord& record, const core::LightSamples& light = {});

    // Makes all rows so far visible to readers of PATH.part. errors  IoError.
    void flush();

    // The fingerprint of the run whose rows these are, before `close`; without it the log says none.
    //
    // errors  FormatError: not 16 hexadecimal digits, or no room was asked for; IoError.
    void set_fingerprint(const std::string& fingerprint);

    void close();

    [[nodiscard]] const std::string& part_path() const;

private:
    std::unique_ptr<LogSink<RawTable>> sink_;
};

}  // namespace zlg::logs
