#include "chi_square_sum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/math/tools/toms748_solve.hpp>

namespace zlg::deviations {
namespace {

// Logarithm of the transform without the pole, and its derivatives, on the real axis.
struct Cumulants {
    double first = 0.0, second = 0.0, third = 0.0;
};

Cumulants cumulants(std::span<const ChiSquarePart> parts, double s) {
    Cumulants k;
    for (const auto& part : parts) {
        const double pull = 2.0 * part.scale / (1.0 + 2.0 * part.scale * s);
        k.first -= 0.5 * part.dof * pull;
        k.second += 0.5 * part.dof * pull * pull;
        k.third -= part.dof * pull * pull * pull;
    }
    return k;
}

double mean_of(std::span<const ChiSquarePart> parts) {
    double sum = 0.0;
    for (const auto& part : parts) sum += part.scale * part.dof;
    return sum;
}

double largest_scale(std::span<const ChiSquarePart> parts) {
    double largest = 0.0;
    for (const auto& part : parts) largest = std::max(largest, part.scale);
    return largest;
}

// Least of s x + K(s) - ln |s| between `low` and `high`, neither of which is reached; its slope rises from -inf to
// +inf.
double saddle(std::span<const ChiSquarePart> parts, double x, double low, double high) {
    for (int step = 0; step < 200 && high - low > 1e-6 * std::abs(low + high); ++step) {
        const double s = low > 0.0 && high > 2.0 * low ? std::sqrt(low * high) : 0.5 * (low + high);
        (x + cumulants(parts, s).first - 1.0 / s > 0.0 ? high : low) = s;
    }
    return 0.5 * (low + high);
}

// The share that scatters little. Below it a path that bends towards negative s would climb; without a bend so many
// degrees of freedom are a quick descent too.
double nearly_constant(std::span<const ChiSquarePart> parts) {
    constexpr double many = 8.0;
    double sum = 0.0;
    for (const auto& part : parts) sum += part.dof >= many ? part.scale * part.dof : 0.0;
    return sum;
}

// Along s0 + iy - b y^2 both halves are conjugate. Poles and branch points lie several steps away.
double integral(std::span<const ChiSquarePart> parts, double x, double s0) {
    constexpr double steps_a_width = 4.0, min_share = 1e-10;
    constexpr int max_steps = 4000;
    const Cumulants k = cumulants(parts, s0);
    const double bend = x > nearly_constant(parts) ? -k.third / (6.0 * k.second) : 0.0;
    const double step = 1.0 / (steps_a_width * std::sqrt(k.second + 1.0 / (s0 * s0)));
    double sum = 0.0, largest = 0.0;
    for (int n = 0; n < max_steps; ++n) {
        const double y = static_cast<double>(n) * step;
        const double re = s0 - bend * y * y;
        double size = re * x, angle = y * x;
        for (const auto& part : parts) {
            const double u = 1.0 + 2.0 * part.scale * re, v = 2.0 * part.scale * y;
            size -= 0.25 * part.dof * std::log(u * u + v * v);
            angle -= 0.5 * part.dof * std::atan2(v, u);
        }
        // ds/(i s) = (1 + 2i bend y) (re - iy)/|s|^2 dy
        size = std::exp(size) / (re * re + y * y);
        const double along_re = re + 2.0 * bend * y * y, along_im = 2.0 * bend * y * re - y;
        const double value = size * (along_re * std::cos(angle) - along_im * std::sin(angle));
        sum += n == 0 ? 0.5 * value : value;
        const double most = size * std::hypot(along_re, along_im);
        largest = std::max(largest, most);
        if (most < min_share * largest) break;
    }
    return sum * step / std::numbers::pi;
}

}  // namespace

Tails tails(std::span<const ChiSquarePart> parts, double x) {
    if (x < mean_of(parts)) {
        double high = 1.0 / x;
        while (x + cumulants(parts, high).first - 1.0 / high < 0.0) high *= 4.0;
        const double below = std::clamp(integral(parts, x, saddle(parts, x, 0.0, high)), 0.0, 1.0);
        return {.below = below, .above = 1.0 - below};
    }
    const double end = -0.5 / largest_scale(parts);
    const double above = std::clamp(-integral(parts, x, saddle(parts, x, end, 0.0)), 0.0, 1.0);
    return {.below = 1.0 - above, .above = above};
}

double quantile(std::span<const ChiSquarePart> parts, const Tails& probability) {
    const bool by_below = probability.below < probability.above;
    const double wanted = std::log(by_below ? probability.below : probability.above);
    constexpr double least = 1e-300;
    // Rises with ln x.
    const auto miss = [&](double log_x) {
        const Tails found = tails(parts, std::exp(log_x));
        return by_below ? std::log(std::max(least, found.below)) - wanted
                        : wanted - std::log(std::max(least, found.above));
    };
    const double centre = std::log(mean_of(parts));
    double low = centre, high = centre, low_miss = miss(centre), high_miss = low_miss;
    for (double step = 0.5; low_miss > 0.0 && step < 1e3; step *= 2.0) low_miss = miss(low -= step);
    for (double step = 0.5; high_miss < 0.0 && step < 1e3; step *= 2.0) high_miss = miss(high += step);
    if (low == high || low_miss == 0.0) return std::exp(low);
    if (high_miss == 0.0) return std::exp(high);
    std::uintmax_t rounds = 60;
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-8; };
    const auto root = boost::math::tools::toms748_solve(miss, low, high, low_miss, high_miss, near, rounds);
    return std::exp(0.5 * (root.first + root.second));
}

}  // namespace zlg::deviations
