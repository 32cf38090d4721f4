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

// Sums over the windows of a run of x at place i, and of products at the places i and i + k, as they follow from those of the
// whole run when its first and last halves are taken off.
struct RunSums {
    const LearntMotion& m;
    double mean = 0.0;
    int n_windows = 0;
    std::array<double, most_window_halves> at{};  // of x at place i

    explicit RunSums(const LearntMotion& memory) noexcept : m{memory} {
        const int length = m.moments.length;
        n_windows = m.n_run - length + 1;
        mean = m.sum / m.n_run;
        double off = 0.0;  // the last L - 1, then one of the first for one of the last
        for (int s = 0; s < length - 1; ++s) off += m.recent[static_cast<unsigned>(s)];
        for (int i = 0; i < length; ++i) {
            at[static_cast<unsigned>(i)] = m.sum - off;
            if (i < length - 1) off += m.head[static_cast<unsigned>(i)] - m.recent[static_cast<unsigned>(i)];
        }
    }

    [[nodiscard]] double less_mean(double products, int i, int j) const noexcept {
        return products - mean * (at[static_cast<unsigned>(i)] + at[static_cast<unsigned>(j)] - n_windows * mean);
    }
};

// Add the moments of a run that ends, for windows that lie in it.
void fold(LearntMotion& m, double forget_ticks) noexcept {
    MotionMoments& moments = m.moments;
    const int length = moments.length;
    if (m.n_run < length) return;
    const RunSums sums{m};
    const double keep = maths::exp(-0.5 * sums.n_windows / forget_ticks);
    moments.n_windows = keep * moments.n_windows + sums.n_windows;
    m.mean_arcsec = m.level_arcsec + sums.mean;
    for (double& x : moments.sum) x *= keep;
    for (int k = 0; k < length; ++k) {
        // Products at the distance k whose earlier half is among the last L - 1 - k of the run, but for the first i of these.
        double off = 0.0;
        for (int s = 0; s + k < length - 1; ++s) off += of(m.recent, s) * of(m.recent, s + k);
        for (int i = 0; i + k < length; ++i) {
            const int j = i + k;
            moments.sum[moment_place(length, i, j)] += 0.5 * sums.less_mean(of(m.product, k) - off, i, j);
            if (i + j == length - 1)  // its own mirror image
                moments.sum[moment_place(length, i, j)] += 0.5 * sums.less_mean(of(m.product, k) - off, i, j);
            if (j < length - 1) off += of(m.head, i) * of(m.head, j) - of(m.recent, i) * of(m.recent, j);
        }
    }
}

void end_run(LearntMotion& m) noexcept {
    m.n_run = m.n_waiting = 0;
    m.sum = 0.0;
    m.product = {};
}

// A run that begins with the last L - 1 halves of the one before it.
void go_on(LearntMotion& m) noexcept {
    const int kept = m.moments.length - 1;
    end_run(m);
    for (int last = 0; last < kept; ++last) {
        for (int k = 0; k <= last; ++k) of(m.product, k) += of(m.recent, last) * of(m.recent, last - k);
        of(m.head, last) = of(m.recent, last);
        m.sum += of(m.recent, last);
    }
    m.n_run = kept;
}

}  // namespace

void start(LearntMotion& memory, int length) noexcept {
    memory = {};
    memory.moments.length = length;
}

void add(LearntMotion& m, std::int64_t half, bool settled, double angle_arcsec, double forget_ticks) noexcept {
    if (!settled) {
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

}  // namespace zlg::core
