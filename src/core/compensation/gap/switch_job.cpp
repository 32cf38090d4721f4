#include <zlg/core/compensation/switch_job.hpp>

namespace zlg::core {
namespace {

SwitchJob* next_job(BackgroundWork& background) noexcept {
    SwitchJob* next = nullptr;
    for (SwitchJob& job : background.job)
        if (job.gap >= 0 && !job.done && (next == nullptr || job.asked_at < next->asked_at)) next = &job;
    return next;
}

void correct_late(const CompensationConstants& gyro, SwitchJob& job) noexcept {
    if (job.plan.n_late == 0) return;
    const SwitchWindow& window = job.plan.window;
    const LightFit fit{window.light, gyro.light_noise.value()};
    if (!fit.is_known()) {
        job.plan.n_late = 0;
        return;
    }
    const double unit = 0.5 * gyro.chi * gyro.bias.value() * gyro.scale.value() * gyro.tick.value();
    int h = window.n_halves - window.light_start;
    for (unsigned k = 0; k < static_cast<unsigned>(job.plan.n_late); ++k, h += 2) {
        const LightHalf first = fit.half(h);
        const LightHalf second = fit.half(h + 1);
        job.late_tick[k] = {
            unit * (fit.angle(first) - fit.angle(second)),
            unit * unit *
                (fit.covariance(first, first) + fit.covariance(second, second) - 2.0 * fit.covariance(first, second))};
    }
}

}  // namespace

void work(const CompensationConstants& gyro, LearntMotion& motion, BackgroundWork& background) noexcept {
    for (;;) {
        SwitchJob* const job = next_job(background);
        if (is_asked(motion) && (job == nullptr || motion.ended.asked_at <= job->asked_at)) {
            fold(motion);
            continue;
        }
        if (job == nullptr) return;
        job->learnt = motion.moments.n_windows >= few_windows;
        job->found = estimate(gyro, job->plan.window, motion.moments, job->scale, background.room);
        correct_late(gyro, *job);
        job->done = true;
        if (job->late) job->gap = -1;
    }
}

}  // namespace zlg::core
