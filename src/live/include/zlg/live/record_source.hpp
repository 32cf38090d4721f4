#pragma once
// What a gyro gives now, tick by tick: over its line, or into a log that another program writes.

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/core/records.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/logs/settings.hpp>

namespace zlg::live {

// A settled tick, and what else is known of the gyro at that time; NaN: not known.
struct Record {
    core::AngleRow angle;
    double detuning_lambda = std::numeric_limits<double>::quiet_NaN();
    double piezo_v = std::numeric_limits<double>::quiet_NaN();
    double temperature_c = std::numeric_limits<double>::quiet_NaN();
    std::uint32_t health = 0;  // bits of core::HealthBit
};

class RecordSource {
public:
    enum class Next { record, nothing, end };

    virtual ~RecordSource() = default;

    // The next record; nothing: none was known within 50 ms.
    //
    // errors  logs::IoError; logs::FormatError of a row that breaks the rules of its log.
    [[nodiscard]] virtual Next next(Record& record) = 0;

    // Reads no more; the records of what has been read follow.
    virtual void stop() = 0;

    // Length of a tick; known from the first record on.
    [[nodiscard]] virtual std::optional<double> tick_s() const = 0;

    // Whether `health` is reported; what else stands above such rows in an angle log.
    [[nodiscard]] virtual bool tells_health() const { return false; }
    [[nodiscard]] virtual logs::Settings settings() const = 0;

    // What a reader must know of the records until now, one line each.
    [[nodiscard]] virtual std::vector<std::string> warnings() const { return {}; }
};

// A gyro's line. Detuning, voltage, temperature and health are those of the last status message.
//
// errors  those of logs::Follower.
[[nodiscard]] std::unique_ptr<RecordSource> line_source(const std::string& source, int baud);

// An angle log that grows (HDF5), until its writer closes it.
[[nodiscard]] std::unique_ptr<RecordSource> log_source(logs::AngleReader log);

// A raw log that grows (HDF5), through this compensation; detuning is the mean of a tick's halves, voltage and
// temperature those of the second half.
//
// name          of the log, in warnings.
// compensation  passed `check`.
// tick_s        of the gyro whose log it is.
[[nodiscard]] std::unique_ptr<RecordSource> log_source(logs::RawReader log, std::string name,
                                                       const core::GyroCompensationConfig& compensation, double tick_s,
                                                       logs::Settings settings);

}  // namespace zlg::live
