#include <zlg/study/compensated_run.hpp>

#include <array>

#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>

#include "gyro_drift.hpp"
#include "reading_error.hpp"

namespace zlg::study {
namespace {

class CompensatedRun {
public:
    CompensatedRun(const config::Config& config, std::int64_t stride)
        : config_{config},
          loop_{config, rig::motion(config)},
          replay_{rig::asked_compensation(config)},
          finder_{config.compensation.relock_ticks},
          meter_{config.gyro.tick_s, stride, gyro_drift(config)} {}

    void tick(std::int64_t tick) {
        const rig::LoopHalf first = loop_.advance();
        replay_.take(first.record, loop_.light());
        const rig::LoopHalf second = loop_.advance();
        finder_.take(tick, first.record, second.record);
        const double before_arcsec = replay_.state().magnetic.subtracted_arcsec;
        const core::AngleSample sample = replay_.take(second.record, loop_.light()).sample;
        truth_[static_cast<std::size_t>(tick) % truth_.size()] = {
            first.truth.dtheta_arcsec + second.truth.dtheta_arcsec,
            replay_.state().magnetic.subtracted_arcsec - before_arcsec, reading_error_arcsec(config_, second)};
        rig::hand_over(sample, [this](const core::AngleRow& row) { take(row); });
    }

    ErrorMeter end() {
        replay_.end([this](const core::AngleRow& row) { take(row); });
        return meter_;
    }

private:
    void take(const core::AngleRow& row) {
        meter_.take(row, truth_[static_cast<std::size_t>(row.tick) % truth_.size()], finder_.windows());
    }

    config::Config config_;
    rig::ClosedLoop loop_;
    rig::Replay replay_;
    SwitchFinder finder_;
    ErrorMeter meter_;
    std::array<TickTruth, core::history_ticks> truth_{};
};

}  // namespace

ErrorMeter compensated_run(const config::Config& config, std::int64_t ticks, std::int64_t stride) {
    CompensatedRun run{config, stride};
    for (std::int64_t tick = 0; tick < ticks; ++tick) run.tick(tick);
    return run.end();
}

}  // namespace zlg::study
