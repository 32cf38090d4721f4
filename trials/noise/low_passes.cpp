#include "low_passes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include <zlg/core/common/maths_kernels.hpp>

namespace zlg::trials {
namespace {

using std::numbers::pi;
using Section = std::array<double, 5>;
namespace maths = core::maths;

Section exponential(double cut_hz) {
    const double a = maths::exp(-2.0 * pi * cut_hz);
    return {1.0 - a, 0.0, 0.0, -a, 0.0};
}

// By the bilinear transform, so that the cut stays where it is.
double warped(double cut_hz) { return maths::sin(pi * cut_hz) / maths::cos(pi * cut_hz); }
Section butterworth_1(double cut_hz) {
    const double k = warped(cut_hz);
    return {k / (1.0 + k), k / (1.0 + k), 0.0, (k - 1.0) / (k + 1.0), 0.0};
}
Section butterworth_2(double cut_hz, double quality) {
    const double k = warped(cut_hz), norm = 1.0 / (1.0 + k / quality + k * k);
    return {k * k * norm, 2.0 * k * k * norm, k * k * norm, 2.0 * (k * k - 1.0) * norm,
            (1.0 - k / quality + k * k) * norm};
}

std::size_t length_of(double times, double cut_hz) {
    return std::max<std::size_t>(2, static_cast<std::size_t>(std::round(times / cut_hz)));
}
std::vector<double> boxcar(std::size_t n) { return std::vector<double>(n, 1.0 / static_cast<double>(n)); }

std::vector<double> convolved(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> c(a.size() + b.size() - 1, 0.0);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
    return c;
}

std::vector<double> hann(std::size_t n) {
    std::vector<double> taps;
    for (std::size_t k = 1; k <= n; ++k)
        taps.push_back((1.0 - maths::cos(2.0 * pi * static_cast<double>(k) / static_cast<double>(n + 1))) /
                       static_cast<double>(n + 1));
    return taps;
}

// |c_0 + c_1 z + c_2 z^2 + ...|^2 at z = exp(-2 pi i f).
double square_of(std::span<const double> c, double frequency_hz) {
    double re = 0.0, im = 0.0;
    for (std::size_t k = 0; k < c.size(); ++k) {
        const maths::SinCos turned = maths::sincos_turns_kernel(frequency_hz * static_cast<double>(k));
        re += c[k] * turned.cos;
        im += c[k] * turned.sin;
    }
    return re * re + im * im;
}

double response(const LowPass& filter, double frequency_hz) {
    double gain = square_of(filter.taps, frequency_hz);
    for (const Section& s : filter.sections)
        gain *= square_of(std::array{s[0], s[1], s[2]}, frequency_hz) /
                square_of(std::array{1.0, s[3], s[4]}, frequency_hz);
    return gain;
}

// The first place of a half.
double bandwidth_of(const LowPass& filter) {
    constexpr double step_hz = 1e-5;
    for (double f = step_hz; f < 0.5; f += step_hz)
        if (response(filter, f) <= 0.5) return f;
    return 0.0;
}

}  // namespace

LowPass low_pass(LowPassKind kind, double cut_hz) {
    // Of a moving average of n samples half is left at 0.443/n, of two at 0.319/n; of a Hann window at 0.72/n; of two
    // exponentials at sqrt(sqrt(2) - 1) of the cut of one. Qualities of Butterworth's poles: 1/(2 cos 22.5 deg) and
    // 1/(2 cos 67.5 deg).
    LowPass f;
    switch (kind) {
        case LowPassKind::none: return f;
        case LowPassKind::exponential: f.sections = {exponential(cut_hz)}; break;
        case LowPassKind::butterworth_1: f.sections = {butterworth_1(cut_hz)}; break;
        case LowPassKind::butterworth_2: f.sections = {butterworth_2(cut_hz, std::sqrt(0.5))}; break;
        case LowPassKind::butterworth_4:
            f.sections = {butterworth_2(cut_hz, 0.5 / maths::cos(pi / 8.0)),
                          butterworth_2(cut_hz, 0.5 / maths::cos(3.0 * pi / 8.0))};
            break;
        case LowPassKind::two_exponentials:
            f.sections.assign(2, exponential(cut_hz / std::sqrt(std::numbers::sqrt2 - 1.0)));
            break;
        case LowPassKind::moving_average: f.taps = boxcar(length_of(0.443, cut_hz)); break;
        case LowPassKind::two_moving_averages:
            f.taps = convolved(boxcar(length_of(0.319, cut_hz)), boxcar(length_of(0.319, cut_hz)));
            break;
        case LowPassKind::held:
            f.held = length_of(0.443, cut_hz);
            f.taps = boxcar(f.held);
            break;
        case LowPassKind::hann: f.taps = hann(length_of(0.72, cut_hz)); break;
    }
    f.bandwidth_hz = bandwidth_of(f);
    return f;
}

// Held values are means over the time that they stand.
void pass(const LowPass& filter, std::vector<double>& values) {
    std::vector<double> out(values.size(), 0.0);
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (k % filter.held != 0) {
            out[k] = out[k - 1];
            continue;
        }
        for (std::size_t i = 0; i < filter.taps.size() && i <= k; ++i) out[k] += filter.taps[i] * values[k - i];
    }
    for (const Section& s : filter.sections) {
        double first = 0.0, second = 0.0;
        for (double& v : out) {
            const double in = v;
            v = s[0] * in + first;
            first = s[1] * in - s[3] * v + second;
            second = s[2] * in - s[4] * v;
        }
    }
    values = std::move(out);
}

}  // namespace zlg::trials
