#include <zlg/core/compensation/learnt_motion.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"
#include "common/pair.hpp"

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
        double* const product = m.product.data();
        const double* const before = m.recent.data() + last;
        int k = 0;
        for (; k < far; k += 2) store(product + k, load(product + k) + x * Pair{before[-k], before[-k - 1]});
        if (k == far) product[k] += x * before[-k];
        m.sum += x;
        if (m.n_run + w < length - 1) of(m.head, m.n_run + w) = x;
    }
    const int all = kept + m.n_waiting;
    const int keep = all < length - 1 ? all : length - 1;
    for (int i = 0; i < keep; ++i) of(m.recent, i) = of(m.recent, all - keep + i);
    m.n_run += m.n_waiting;
    m.n_waiting = 0;
}

// Sum of products at the distance k within n steps.
double products_within(const double* x, int n, int k) noexcept {
    double sum = 0.0;
    for (int s = 0; s + k < n; ++s) sum += x[s] * x[s + k];
    return sum;
}

// Add the moments of the run, for all windows that lie in it.
void fold(LearntMotion& m, double forget_ticks) noexcept {
    MotionMoments& moments = m.moments;
    const int length = moments.length;
    if (m.n_run < length) return;
    const int n_windows = m.n_run - length + 1;
    const double mean = m.sum / m.n_run;
    // Sum over the windows of x at place i: that of the whole run without its last L - 1, then with one of these for
    // one of the first.
    std::array<double, most_moment_steps> sum{};
    double off_run = 0.0;
    for (int s = 0; s < length - 1; ++s) off_run += of(m.recent, s);
    for (int i = 0; i < length; ++i) {
        of(sum, i) = m.sum - off_run;
        if (i < length - 1) off_run += of(m.head, i) - of(m.recent, i);
    }
    const double keep = maths::exp(-0.5 * moments.step_halves * n_windows / forget_ticks);
    moments.n_windows = keep * moments.n_windows + n_windows;
    for (double& x : moments.sum) x *= keep;
    for (int k = 0; k < length; ++k) {
        double all = of(m.product, k);
        if (m.goes_on) all += products_within(m.head.data(), length - 1, k);
        // Products at the distance k whose earlier step is among the last L - 1 - k of the run, but for the first i of
        // these.
        double off = products_within(m.recent.data(), length - 1, k);
        for (int i = 0; i + k < length; ++i) {
            const int j = i + k;
            // Of its own mirror image all, of others half.
            moments.sum[moment_place(length, i, j)] +=
                (i + j == length - 1 ? 1.0 : 0.5) * (all - off - mean * (of(sum, i) + of(sum, j) - n_windows * mean));
            if (j < length - 1) off += of(m.head, i) * of(m.head, j) - of(m.recent, i) * of(m.recent, j);
        }
    }
}

void end_run(LearntMotion& m) noexcept {
    m.n_run = m.n_waiting = 0;
    m.goes_on = false;
    m.sum = 0.0;
    for (double& x : m.product) x = 0.0;
}

// A run that begins with the last L - 1 steps of the one before it.
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

}  // namespace

void start(LearntMotion& memory, int length, int step_halves) noexcept {
    memory = {};
    memory.moments.length = length;
    memory.moments.step_halves = step_halves;
}

void add(LearntMotion& m, std::int64_t half, bool settled, double angle_arcsec, double forget_ticks) noexcept {
    if (!settled) {
        if (m.n_run + m.n_waiting == 0) return;
        fold(m, forget_ticks);
        return end_run(m);
    }
    if (m.n_run + m.n_waiting == 0) m.level_arcsec = angle_arcsec;
    const int kept = m.n_run < m.moments.length - 1 ? m.n_run : m.moments.length - 1;
    of(m.recent, kept + m.n_waiting++) = angle_arcsec - m.level_arcsec;
    if ((half + 1) % part_halves != 0) return;
    take_part(m);
    if ((half + 1) % block_halves != 0 || m.n_run < m.moments.length) return;
    fold(m, forget_ticks);
    go_on(m);
}

void add(MotionSpread& spread, bool settled, double first_arcsec, double second_arcsec, double forget_ticks) noexcept {
    if (!settled) {
        spread.goes_on = false;
        return;
    }
    if (spread.n_ticks < forget_ticks) spread.n_ticks += 1.0;
    const double part = 1.0 / spread.n_ticks;
    const double off = first_arcsec + second_arcsec - 2.0 * spread.mean_half_arcsec;
    spread.mean_half_arcsec += 0.5 * part * off;
    spread.tick_arcsec2 += part * (square(off) * (1.0 - part) - spread.tick_arcsec2);
    if (spread.goes_on) {
        const auto [p, q] = spread.last_arcsec;
        const double sq = 0.5 * (square(p - 2.0 * q + first_arcsec) + square(q - 2.0 * first_arcsec + second_arcsec));
        spread.second_difference_arcsec2 += part * (sq - spread.second_difference_arcsec2);
    }
    spread.goes_on = true;
    spread.last_arcsec = {first_arcsec, second_arcsec};
}

}  // namespace zlg::core
