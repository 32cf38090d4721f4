#include <zlg/core/common/handover.hpp>
#include <zlg/core/compensation/gap_bridge.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

SwitchJob* next_job(BackgroundWork& background) noexcept {
    SwitchJob* next = nullptr;
    for (SwitchJob& job : background.job) {
        // Nobody waits for it, and nobody works at it.
        if (hand_over_if(job.state, JobState::late, JobState::free)) continue;
        if (taken(job.state) == JobState::asked && (next == nullptr || job.asked_at < next->asked_at)) next = &job;
    }
    return next;
}

// One tick of the history.
void learn(const GapBridgeConfig& config, const HistoryTick& entry, LearntMotion& motion) noexcept {
    const int step_halves = window_step_halves(config);
    const int length = window_halves(config) / step_halves;
    const std::int64_t tick = motion.next_tick++;
    const bool is_new = motion.moments.length != length || motion.moments.step_halves != step_halves;
    if (is_new || motion.with_phase != entry.by_phase) {
        // What was learnt by counts holds other roundings, thousands of times as large or small.
        start(motion, length, step_halves);
        motion.next_tick = tick + 1;
        motion.with_phase = entry.by_phase;
    }
    // Nothing is learnt from a tick that others have overwritten.
    const bool settled = entry.row.tick == tick && is_settled(entry);
    const auto& half = entry.read.half;
    if (step_halves == 2)
        return add(motion, 2 * tick + 1, settled, half[0].angle_arcsec + half[1].angle_arcsec, forget_ticks);
    for (int k = 0; k < 2; ++k)
        add(motion, 2 * tick + k, settled, half[static_cast<unsigned>(k)].angle_arcsec, forget_ticks);
}

// Those that there are, up to one of them.
void learn_until(const GapBridgeConfig& config, GapBridgeState& state, std::uint32_t n_ticks) noexcept {
    LearntMotion& motion = state.background.motion;
    while (static_cast<std::int32_t>(n_ticks - static_cast<std::uint32_t>(motion.next_tick)) > 0)
        learn(config, at(state, motion.next_tick), motion);
}

void correct_late(const CompensationConstants& gyro, SwitchJob& job) noexcept {
    if (job.n_late == 0) return;
    const SwitchWindow& window = job.window;
    const LightFit fit{window.light, gyro.light_noise.value(), gyro.bend};
    if (!fit.is_known()) job.n_late = 0;
    const double unit = arcsec_per_lambda2(gyro, gyro.bias);
    int h = window.n_halves - window.light_start;
    for (unsigned k = 0; k < static_cast<unsigned>(job.n_late); ++k, h += 2) {
        const LightHalf first = fit.half(h);
        const LightHalf second = fit.half(h + 1);
        const double variance =
            fit.covariance(first, first) + fit.covariance(second, second) - 2.0 * fit.covariance(first, second);
        job.late_arcsec[k] = static_cast<float>(unit * (fit.angle(first) - fit.angle(second)));
        job.late_arcsec2[k] = static_cast<float>(unit * unit * variance);
    }
}

}  // namespace

void work(const CompensationConstants& gyro, const GapBridgeConfig& config, GapBridgeState& state, Pause pause,
          std::span<const BankMember> bank) noexcept {
    BackgroundWork& background = state.background;
    const MotionMoments& moments = background.motion.moments;
    // Those that there were before a switch may have been asked for.
    std::uint32_t n_ticks = taken(background.n_ticks);
    for (SwitchJob* job = nullptr; (job = next_job(background)) != nullptr; n_ticks = taken(background.n_ticks)) {
        learn_until(config, state, static_cast<std::uint32_t>(job->asked_at));
        job->learnt = moments.n_windows >= few_windows;
        job->found = estimate(gyro, job->window, moments, job->scale, background.room, bank, pause);
        correct_late(gyro, *job);
        if (!hand_over_if(job->state, JobState::asked, JobState::done)) hand_over(job->state, JobState::free);
    }
    learn_until(config, state, n_ticks);
}

}  // namespace zlg::core
