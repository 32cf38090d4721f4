#pragma once
// The angle log: one row per tick, as CSV or HDF5.

#include <memory>
#include <string>

#include <zlg/core/records.hpp>
#include <zlg/logs/angle_layout.hpp>

namespace zlg::logs {

template <class Table> class LogSource;
template <class Table> class LogSink;

// Reads rows in order and checks every one by the rules of AngleTable. The format is recognised by the content.
class AngleReader {
public:
    // An HDF5 log may be open in a writer, or left behind by one that was killed: its whole rows are there.
    //
    // errors  IoError, FormatError (an empty file, no header, a missing or misspelt column, one of a wrong kind).
    explicit AngleReader(const std::string& path);
    ~AngleReader();
    AngleReader(AngleReader&&) noexcept;

    [[nodiscard]] const AngleHeader& header() const;

    // The next row; false at the end. errors FormatError: path, line or row, column, value, what is allowed.
    bool next(TimedAngle& angle);

    // Looks for rows that have been written since; true: `next` has more. Also renews header().complete.
    bool refresh();

    // Of the file, 0..1, a buffer ahead of the rows.
    [[nodiscard]] double fraction_read() const;

private:
    std::unique_ptr<LogSource<AngleTable>> source_;
};

// Writes the columns of AngleTable, in the format that the suffix says: .csv,
// .h5 or .hdf5; CSV reals in the shortest form that reads back. With the suffix .mcap it writes a bag for other
// programs: sensor_msgs/msg/Imu, which no AngleReader reads.
//
// The file appears under its name at `close`, whole, or not at all. As HDF5 it grows as PATH.part, which can be read
// meanwhile and after a crash, up to the last `flush`; every 16384 rows are flushed by themselves.
class AngleWriter {
public:
    // Settings `flags` and `tick_s`, as a reader hands them out, stand for the writer's own lines, or as HDF5
    // attributes, of that name. A `tick_s` of NaN is not known and not written.
    //
    // errors  IoError (another suffix included), FormatError (a setting with a line break; HDF5: a tick_s of no
    // number).
    AngleWriter(const std::string& path, double tick_s, const Settings& settings, bool force,
                const AngleWriterOptions& options = {});
    ~AngleWriter();
    AngleWriter(AngleWriter&&) noexcept;

    // errors  IoError; FormatError: an angle that is not finite, a sigma that is negative or NaN.
    void write(const core::AngleRow& row, double truth_dtheta_arcsec = 0.0);

    // With a time of its own, as read from another log.
    void write_timed(const TimedAngle& angle);

    // Makes all rows so far visible to readers of PATH.part. errors  IoError.
    void flush();

    // The fingerprint of the run whose rows these are, before `close`; without it the log says none.
    //
    // errors  FormatError: not 16 hexadecimal digits, or no room was asked for; IoError.
    void set_fingerprint(const std::string& fingerprint);

    void close();

    [[nodiscard]] const std::string& part_path() const;

private:
    std::unique_ptr<LogSink<AngleTable>> sink_;
    double tick_s_;
};

}  // namespace zlg::logs
