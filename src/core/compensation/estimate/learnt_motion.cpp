#include <zlg/core/compensation/learnt_motion.hpp>

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

double& of(auto& numbers, int i) noexcept { return numbers[static_cast<unsigned>(i)]; }

// P_k of the halves that wait: each with the L - 1 before it that belong to the run.
void take_part(LearntMotion& m) noexcept {
    const int length = m.moments.length;
    const int kept = m.n_run < length - 1 ? m.n_run : length - 1;
    for (int w = 0; w < m.n_waiting; ++w) {
        const int last = kept + w;
        const double x = of(m.recent, last);
        const int far = last < length - 1 ? last : length - 1;
        for (int k = 0; k <= far; ++k) of(m.product, k) += x * of(m.recent, last - k);
        m.sum += x;
        if (m.n_run + w < length - 1) of(m.head, m.n_run + w) = x;
    }
    const int all = kept + m.n_waiting;
    const int keep = all < length - 1 ? all : length - 1;
    for (int i = 0; i < keep; ++i) of(m.recent, i) = of(m.recent, all - keep + i);
    m.n_run += m.n_waiting;
    m.n_waiting = 0;
}

// Sums over the windows of a run of x at place i, as they follow from that of the whole run when its first and last halves are
// taken off.
struct RunSums {
    double mean = 0.0;
    int n_windows = 0;
    std::array<double, most_moment_steps> at{};

    RunSums(const EndedRun& run, int length) noexcept {
        n_windows = run.n - length + 1;
        mean = run.sum / run.n;
        double off = 0.0;  // the last L - 1, then one of the first for one of the last
        for (int s = 0; s < length - 1; ++s) off += run.tail[static_cast<unsigned>(s)];
        for (int i = 0; i < length; ++i) {
            at[static_cast<unsigned>(i)] = run.sum - off;
            if (i < length - 1) off += run.head[static_cast<unsigned>(i)] - run.tail[static_cast<unsigned>(i)];
        }
    }

    [[nodiscard]] double less_mean(double products, int i, int j) const noexcept {
        return products - mean * (at[static_cast<unsigned>(i)] + at[static_cast<unsigned>(j)] - n_windows * mean);
    }
};

// Sum of products at the distance k within n halves.
double products_within(const std::array<double, most_moment_steps>& x, int n, int k) noexcept {
    double sum = 0.0;
    for (unsigned s = 0; s + static_cast<unsigned>(k) < static_cast<unsigned>(n); ++s)
        sum += x[s] * x[s + static_cast<unsigned>(k)];
    return sum;
}

void ask(LearntMotion& m, std::int64_t half, double forget_ticks) noexcept {
    const int length = m.moments.length;
    if (m.n_run < length || is_asked(m)) return;
    EndedRun& run = m.ended;
    run.asked_at = half;
    run.goes_on = m.goes_on;
    run.level_arcsec = m.level_arcsec;
    run.forget_ticks = forget_ticks;
    run.n = m.n_run;
    run.sum = m.sum;
    for (int k = 0; k < length; ++k) of(run.product, k) = of(m.product, k);
    for (int s = 0; s < length - 1; ++s) {
        of(run.head, s) = of(m.head, s);
        of(run.tail, s) = of(m.recent, s);
    }
    run.done = false;
}

void end_run(LearntMotion& m) noexcept {
    m.n_run = m.n_waiting = 0;
    m.goes_on = false;
    m.sum = 0.0;
    for (double& x : m.product) x = 0.0;
}

// A run that begins with the last L - 1 halves of the one before it.
void go_on(LearntMotion& m) noexcept {
    const int kept = m.moments.length - 1;
    end_run(m);
    m.goes_on = true;
    for (int s = 0; s < kept; ++s) {
        of(m.head, s) = of(m.recent, s);
        m.sum += of(m.recent, s);
    }
    m.n_run = kept;
}

MotionSummary summary_of(const MotionMoments& m, double mean_arcsec) noexcept {
    const auto c = [&m](int i, int j) { return m.sum[moment_place(m.length, i, j)] / m.n_windows; };
    // By ticks lit halves are not judged.
    if (m.step_halves == 2)
        return {.n_windows = m.n_windows, .mean_half_arcsec = 0.5 * mean_arcsec, .tick_arcsec2 = c(0, 0)};
    return {.n_windows = m.n_windows,
            .mean_half_arcsec = mean_arcsec,
            .tick_arcsec2 = c(0, 0) + c(1, 1) + 2.0 * c(0, 1),
            .second_difference_arcsec2 = c(0, 0) + 4.0 * c(1, 1) + c(2, 2) - 4.0 * (c(0, 1) + c(1, 2)) + 2.0 * c(0, 2)};
}

}  // namespace

void fold(LearntMotion& m) noexcept {
    MotionMoments& moments = m.moments;
    EndedRun& run = m.ended;
    const int length = moments.length;
    const RunSums sums{run, length};
    const double keep = maths::exp(-0.5 * moments.step_halves * sums.n_windows / run.forget_ticks);
    moments.n_windows = keep * moments.n_windows + sums.n_windows;
    for (double& x : moments.sum) x *= keep;
    for (int k = 0; k < length; ++k) {
        double all = of(run.product, k);
        if (run.goes_on) all += products_within(run.head, length - 1, k);
        // Products at the distance k whose earlier half is among the last L - 1 - k of the run, but for the first i of these.
        double off = products_within(run.tail, length - 1, k);
        for (int i = 0; i + k < length; ++i) {
            const int j = i + k;
            // Of its own mirror image all, of others half.
            moments.sum[moment_place(length, i, j)] +=
                (i + j == length - 1 ? 1.0 : 0.5) * sums.less_mean(all - off, i, j);
            if (j < length - 1) off += of(run.head, i) * of(run.head, j) - of(run.tail, i) * of(run.tail, j);
        }
    }
    m.folded = summary_of(moments, run.level_arcsec + sums.mean);
    run.done = true;
}

void start(LearntMotion& memory, int length, int step_halves) noexcept {
    memory = {};
    memory.moments.length = length;
    memory.moments.step_halves = step_halves;
}

void add(LearntMotion& m, std::int64_t half, bool settled, double angle_arcsec, double forget_ticks) noexcept {
    if (m.ended.asked_at >= 0 && m.ended.done && half >= m.ended.asked_at + fold_halves) {
        m.summary = m.folded;
        m.ended.asked_at = -1;
    }
    if (!settled) {
        if (m.n_run + m.n_waiting == 0) return;
        ask(m, half, forget_ticks);
        return end_run(m);
    }
    if (m.n_run + m.n_waiting == 0) m.level_arcsec = angle_arcsec;
    const int kept = m.n_run < m.moments.length - 1 ? m.n_run : m.moments.length - 1;
    of(m.recent, kept + m.n_waiting++) = angle_arcsec - m.level_arcsec;
    if ((half + 1) % part_halves != 0) return;
    take_part(m);
    if ((half + 1) % block_halves != 0 || m.n_run < m.moments.length) return;
    ask(m, half, forget_ticks);
    go_on(m);
}

}  // namespace zlg::core
