#pragma once
// The half-wave voltage as the switches of a recorded log measured it.
//
// The core's sequencer of switches is led through the records: its loop opens and closes where that of the log did. So
// lock and readings are judged as in the gyro, and the filter has the same measurements.

#include <cstdint>
#include <map>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/core/control/mode_switch.hpp>
#include <zlg/core/records.hpp>
#include <zlg/rig/measured_half_wave.hpp>
#include <zlg/study/switch_table.hpp>

namespace zlg::study {

class HalfWaveReplay {
public:
    // config  that of the log; one that the control refuses shows nothing.
    explicit HalfWaveReplay(const config::Config& config);

    // The next half. One without voltage or detuning shows nothing.
    void take(const core::HalfRecord& half);

    // What was known after each of these switches: of those whose lock is in the log.
    void fill(std::vector<SwitchLine>& lines) const;

private:
    void step(const core::HalfRecord& half, const core::HalfRecord& next);

    bool possible_ = true;
    core::ModeSwitchConfig sequence_;
    core::ModeSwitchState state_;
    rig::MeasuredHalfWave half_wave_;
    core::HalfRecord last_;
    std::int64_t n_halves_ = 0;
    bool measured_ = false;
    std::map<std::int64_t, rig::MeasuredHalfWave> after_;  // by the first tick of the gap
};

}  // namespace zlg::study
