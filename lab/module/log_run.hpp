#pragma once
// A recorded log on the page: a raw log goes through the compensation as in `zlg process`, and beside it through those
// that the page compares it with; an angle log is shown as it is. Text of another program is made one of these, as by
// `zlg import`. What comes out are rows of numbers.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/core/compensation/gap_bridge_state.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/imported.hpp>
#include <zlg/logs/raw_log.hpp>
#include <zlg/recorded/log_compensation.hpp>
#include <zlg/rig/replay.hpp>

#include "queue.hpp"

namespace zlg::lab {

class LogRun {
public:
    // name      of the file, for messages; it is read as page_file.cpp says.
    // settings  over those of the log, `section.key=value` each, as --set of `zlg process`; of a file of another
    //           program also `key=value` of --map of `zlg import`.
    //
    // errors  config::ConfigError, logs::FormatError, logs::MappingError, logs::IoError, with the program's own
    // messages.
    LogRun(std::string name, std::span<const std::string> settings);

    // The next rows of the file, at most so many; false: there are no more, and all that is shown is settled.
    //
    // errors  as above; the message names row, column and value.
    bool advance(std::int64_t rows);

    //   ticks     a row a tick, in their order: tick; increment as read, delivered, final, arcsec; sigma of the final
    //             one; flags; mode; detuning of the second half, lambda; piezo voltage, V; angle since the start as
    //             delivered, final, and without corrections and by the paper, each less the final one, arcsec. NaN: the
    //             log does not say.
    //   switches  a row for each: first tick; ticks of the gap; mode after; dP of eq (16), arcsec
    [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }
    [[nodiscard]] const std::vector<double>& switches() const { return switches_; }
    void forget();

    [[nodiscard]] double fraction_read() const;
    [[nodiscard]] const config::Config& config() const { return config_; }
    [[nodiscard]] bool is_raw() const { return raw_.has_value(); }
    // One line for each thing that the program would say beside the result, complete at the end.
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

private:
    struct Compared {
        explicit Compared(const core::GyroCompensationConfig& config) : replay{config} {}
        rig::Replay replay;
        Queue<double> final_arcsec;  // of ticks that another compensation has not settled yet
        core::ExactSum less_configured;
    };
    struct SeenTick {
        double read_arcsec = 0.0;
        double detuning_lambda = 0.0;
        double piezo_v = 0.0;
    };

    void open_raw(logs::RawReader&& raw, std::span<const std::string> settings);
    void open_angles(std::span<const std::string> settings);
    void open_foreign(std::span<const std::string> settings);
    void take_axis(const logs::ImportedAxis& axis, std::span<const std::string> settings);
    bool take_row();
    void take(const core::HalfRecord& half);
    void take(const logs::TimedAngle& angle);
    void note_switch(const core::GapReport& gap);
    void add_ticks();
    void end();
    [[nodiscard]] SeenTick& seen(std::int64_t tick) { return seen_[static_cast<std::size_t>(tick) % seen_.size()]; }

    std::string name_;
    config::Config config_;
    std::optional<logs::RawReader> raw_;
    std::optional<logs::AngleReader> angles_;
    std::vector<core::AngleRow> rows_;  // in place of a reader of angles
    std::size_t next_row_ = 0;
    bool lacks_detuning_ = false;
    std::optional<rig::Replay> configured_;
    std::vector<Compared> compared_;  // as read, by the paper
    core::ExactSum delivered_arcsec_;
    core::ExactSum final_arcsec_;
    Queue<core::AngleRow> final_;
    std::optional<core::HalfRecord> first_;  // of the tick that has begun
    std::array<SeenTick, core::history_ticks> seen_{};
    std::vector<double> ticks_;
    std::vector<double> switches_;
    std::vector<std::string> notes_;
    bool ended_ = false;
};

}  // namespace zlg::lab
