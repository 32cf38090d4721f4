#pragma once
// What a log can do, whatever its format and whatever its rows are.

#include <memory>
#include <string>

#include <fmt/format.h>

#include <zlg/core/records.hpp>
#include <zlg/logs/angle_layout.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/file_nature.hpp>
#include <zlg/logs/raw_layout.hpp>

namespace zlg::logs {

template <class Table> class LogSource {
public:
    virtual ~LogSource() = default;
    virtual bool next(typename Table::Row& row) = 0;
    // Complains of a value of the row that was read last. errors  FormatError, always.
    [[noreturn]] virtual void refuse_last(std::string_view column, std::int64_t value, const std::string& what) = 0;
    virtual bool refresh() { return false; }
    [[nodiscard]] virtual core::LightSamples light() const { return {}; }
    [[nodiscard]] virtual bool line_is_ended() const { return true; }
    [[nodiscard]] virtual double fraction_read() const = 0;
    [[nodiscard]] const typename Table::Header& header() const { return header_; }

protected:
    typename Table::Header header_;
};

template <class Table> class LogSink {
public:
    virtual ~LogSink() = default;
    virtual void write(const typename Table::Row& row, const core::LightSamples& light) = 0;
    virtual void flush() = 0;
    // errors  FormatError: no room was asked for; IoError.
    virtual void set_fingerprint(const std::string& fingerprint) = 0;
    virtual void close() = 0;
    [[nodiscard]] virtual const std::string& part_path() const = 0;
};

template <class Table> [[nodiscard]] std::unique_ptr<LogSource<Table>> open_csv(const std::string& path);
[[nodiscard]] std::unique_ptr<LogSource<RawTable>> open_raw_hdf5(const std::string& path);
[[nodiscard]] std::unique_ptr<LogSource<AngleTable>> open_angle_hdf5(const std::string& path);

// As in AngleWriterOptions.
struct CsvOptions {
    bool keep_part = false;
    bool has_fingerprint = false;
    FormatVersion format_version = logs::format_version;
};

// A log of the given columns, with these settings above it.
template <class Table>
[[nodiscard]] std::unique_ptr<LogSink<Table>> create_csv(const std::string& path, bool force, const Settings& settings,
                                                         const typename Table::Presence& columns,
                                                         const CsvOptions& options);
[[nodiscard]] std::unique_ptr<LogSink<RawTable>> create_raw_hdf5(const std::string& path, bool force,
                                                                 const Settings& settings, const RawColumns& columns,
                                                                 const RawWriterOptions& options);
[[nodiscard]] std::unique_ptr<LogSink<AngleTable>> create_angle_hdf5(const std::string& path, bool force,
                                                                     const Settings& settings,
                                                                     const AngleWriterOptions& options);
// A bag of MCAP with messages of an IMU. errors  FormatError: tick_s is not known; IoError.
[[nodiscard]] std::unique_ptr<LogSink<AngleTable>> create_imu_bag(const std::string& path, double tick_s, bool force);

// By the content. errors  as the readers; FormatError: a file of another program, of which it says what it is.
template <class Table>
std::unique_ptr<LogSource<Table>> open_log(const std::string& path,
                                           std::unique_ptr<LogSource<Table>> (*open_hdf5)(const std::string&)) {
    if (has_hdf5_signature(path)) return open_hdf5(path);
    refuse_foreign(path);
    return open_csv<Table>(path);
}

// Which of the optional columns `log.has`.
template <class Log> void note_columns(const Log& log, RawColumns& columns) {
    for_each_column<RawTable>([&]<class Field>(const Field& field, std::size_t column) {
        if constexpr (Field::is_optional) columns.*field.is_there = log.has(column);
    });
}

// What no reader would accept is not written: a real number against its rule, a value that has no column but needs one.
//
// errors  FormatError.
template <class Table> void require_loggable(const typename Table::Row& row, const typename Table::Presence& columns) {
    const auto refuse = [&row](const std::string& what) {
        const auto& number = std::get<0>(Table::columns);
        throw FormatError(fmt::format("{} {} cannot be logged: {}", number.name, number.of(row), what));
    };
    for_each_column<Table>([&]<class Field>(const Field& field, std::size_t) {
        const auto value = field.of(row);
        if constexpr (std::is_floating_point_v<typename Field::Value>) {
            if (!field.rule.allows(value, 0) && field.is_in(columns))
                refuse(fmt::format("{} = {} {}", field.name, value, field.rule.fault(value, 0)));
        } else if (field.is_needed && value != field.absent && !field.is_in(columns)) {
            refuse(fmt::format("{} is {}, and the log has no column for it", field.name, value));
        }
    });
}

}  // namespace zlg::logs
