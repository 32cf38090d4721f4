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

void MeteredCompensation::leap(const rig::Leap& leap) {
    const double arcsec = replay_.leap(leap, [this](const core::AngleRow& row) { take(row); });
    meter_.leap(leap.ticks(), arcsec - leap.dtheta_arcsec);
    tick_ += leap.ticks();
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

void MeteredCompensation::follow(rig::ClosedLoop& loop, std::int64_t ticks) {
    for (std::int64_t half = 0; half < 2 * ticks;) {
        if (const auto passed = half % 2 == 0 ? loop.leap(2 * ticks - half) : std::nullopt) {
            leap(*passed);
            half += passed->halves;
            continue;
        }
        const rig::LoopHalf now = loop.advance();
        take(now, loop.light());
        ++half;
    }
}

ErrorMeter compensated_run(const config::Config& config, std::int64_t ticks, std::int64_t stride) {
    rig::ClosedLoop loop{config, recorded::motion(config)};
    MeteredCompensation compensation{config, stride};
    compensation.follow(loop, ticks);
    return compensation.end();
}

}  // namespace zlg::study
