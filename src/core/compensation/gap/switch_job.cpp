#include <zlg/core/compensation/switch_job.hpp>

namespace zlg::core {
namespace {

SwitchJob* next_job(BackgroundWork& background) noexcept {
    SwitchJob* next = nullptr;
    for (SwitchJob& job : background.job)
        if (job.gap >= 0 && !job.done && (next == nullptr || job.asked_at < next->asked_at)) next = &job;
    return next;
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
        job->done = true;
        if (job->late) job->gap = -1;
    }
}

}  // namespace zlg::core
