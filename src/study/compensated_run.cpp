#include <zlg/recorded/motion.hpp>
#include <zlg/study/compensated_run.hpp>

#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/gyro_drift.hpp>
#include <zlg/study/reading_error.hpp>

namespace zlg::study {

MeteredCompensation::MeteredCompensation(const config::Config& config, std::int64_t stride)
    : config_{config},
      replay_{rig::asked_compensation(config)},
      finder_{config.compensation.relock_ticks},
      meter_{config.gyro.tick_s, stride, RunDrift{config}} {}

void MeteredCompensation::take(const rig::LoopHalf& half, core::LightSamples light) {
    if (!is_second_) {
        replay_.take(half.record, light);
        first_ = half.record;
        first_arcsec_ = half.truth.dtheta_arcsec;
    } else {
        finder_.take(tick_, first_, half.record);
        const double before_arcsec = replay_.state().magnetic.subtracted_arcsec;
        const core::AngleSample sample = replay_.take(half.record, light).sample;
        truth_[static_cast<std::size_t>(tick_) % truth_.size()] = {
            first_arcsec_ + half.truth.dtheta_arcsec, replay_.state().magnetic.subtracted_arcsec - before_arcsec,
            reading_error_arcsec(config_, half)};
        rig::hand_over(
            sample, [this](const core::AngleRow& row) { take(row); },
            [this](const core::GapReport& gap) { take(gap); });
        ++tick_;
    }
    is_second_ = !is_second_;
}

const ErrorMeter& MeteredCompensation::end() {
    replay_.end([this](const core::AngleRow& row) { take(row); }, [this](const core::GapReport& gap) { take(gap); });
    return meter_;
}

void MeteredCompensation::take(const core::AngleRow& row) {
    const TickTruth& truth = truth_[static_cast<std::size_t>(row.tick) % truth_.size()];
    meter_.take(row, truth, finder_.windows());
    if (on_row) on_row(row, truth);
}

void MeteredCompensation::take(const core::GapReport& gap) const {
    if (on_gap) on_gap(gap);
}

ErrorMeter compensated_run(const config::Config& config, std::int64_t ticks, std::int64_t stride) {
    rig::ClosedLoop loop{config, recorded::motion(config)};
    MeteredCompensation compensation{config, stride};
    for (std::int64_t half = 0; half < 2 * ticks; ++half) {
        const rig::LoopHalf now = loop.advance();
        compensation.take(now, loop.light());
    }
    return compensation.end();
}

}  // namespace zlg::study
