#pragma once
// A raw log through the compensation, for what it shows of switches and of faults.

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/core/records.hpp>
#include <zlg/study/switch_table.hpp>

#include "run_record.hpp"

namespace zlg::acceptance {

// Within which the mean detuning of a half stays when a lock is settled.
inline constexpr double settled_lambda = 0.02;

class SwitchReader {
public:
    explicit SwitchReader(const config::Config& config);

    void take(const core::HalfRecord& half);
    void take(const core::AngleRow& row);
    void take(const core::GapReport& gap) { table_.take(gap); }

    [[nodiscard]] SwitchRecord finish();

private:
    void follow_lock(const core::HalfRecord& half);
    void end_lock();

    const config::Config& config_;
    study::SwitchTable table_;
    core::HalfRecord first_;
    std::int64_t n_halves_ = 0;
    double detuning_ = std::numeric_limits<double>::quiet_NaN();  // the first one
    bool detuning_varies_ = false;
    bool was_closed_ = true;
    int mode_before_open_ = 0;
    std::int64_t closed_halves_ = -1;  // since a switch; -1: none is followed
    std::int64_t last_beyond_ = 0;     // the last of them that was not settled
    std::int64_t ticks_ = 0;
    bool in_gap_ = false, gap_switches_ = false;
    SwitchRecord record_;
};

}  // namespace zlg::acceptance
