#pragma once
// What the logs of one run hold: axes for the noise analysis, and of raw logs what only a switched gyro has.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <zlg/acceptance/accept.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/study/axis.hpp>
#include <zlg/study/switch_table.hpp>

namespace zlg::acceptance {

// What one raw log shows of its switches.
struct SwitchRecord {
    std::vector<study::SwitchLine> lines;
    std::vector<double> relock_s;          // of each switch after which the detuning was seen to settle
    bool detuning_is_dead = false;         // absent, or one value throughout
    std::int64_t unsettled = 0;            // switches after which it was not, in the halves that are looked at
    std::int64_t alarms = 0;               // stretches without a trusted reading that belong to no switch
    std::optional<std::int64_t> withheld;  // absent: the log does not say when switches are due
    double hours = 0.0;
    double half_s = 0.0;
};

struct RunRecord {
    const Run* run = nullptr;
    std::vector<TestedLog> logs;
    std::vector<study::AxisRecord> axes;
    std::vector<std::string> raw_logs;  // paths
    std::vector<SwitchRecord> switches;
    std::vector<double> table_rates_arcsec_s;  // where a column holds the rate of the table
    std::vector<config::Config> configs;       // of the logs of zlg
    double hours = 0.0;
    std::vector<std::string> notes;
    std::vector<std::string> stops;  // why its values are no measurements of this gyro: no verdict rests on them
};

// said  keys that the user gives over what the logs say.
//
// errors  logs::IoError, logs::FormatError, logs::MappingError, config::ConfigError: another serial number too.
[[nodiscard]] RunRecord read_run(const Plan& plan, const Run& run, const config::Config& said);

// A raw log of zlg, or what the mapping of the run makes of another program's file.
[[nodiscard]] logs::RawReader open_raw(const Run& run, const std::string& path, std::vector<std::string>& notes);

}  // namespace zlg::acceptance
