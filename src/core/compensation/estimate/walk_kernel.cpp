#include <zlg/core/compensation/walk_kernel.hpp>

namespace zlg::core {
namespace {

// Gauss and Legendre's four points and weights on -1..1: exact for polynomials to the seventh order; a^2 is of the
// sixth.
constexpr double gauss_point[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
constexpr double gauss_weight[4] = {0.34785484513745385, 0.6521451548625461, 0.6521451548625461, 0.34785484513745385};

double power(double x, int k) noexcept { return k == 2 ? x * x : x * x * x; }

// Adds the moments and the variance of a stretch between the times from and to, over which (1) is one polynomial.
void add_piece(int kind, double start, double end, double from, double to, WalkedStretch& sum) noexcept {
    if (!(to > from)) return;
    const double middle = 0.5 * (to + from);
    const double size = 0.5 * (to - from);
    for (int i = 0; i < 4; ++i) {
        const double q = middle + size * gauss_point[i];
        const double before = start > q ? power(start - q, kind) : 0.0;
        const double a = (power(end - q, kind) - before) / kind;
        double weighted = size * gauss_weight[i] * a;
        sum.variance += weighted * a;
        for (int m = 0; m < kind; ++m, weighted *= q) sum.moment[m] += weighted;
    }
}

}  // namespace

WalkedStretch walked(const Walk& walk, const Stretch& stretch) noexcept {
    WalkedStretch result;
    const double s = stretch.first - walk.first;
    const double e = stretch.last - walk.first;
    const double to = walk.last - walk.first;
    const double w = e - s;
    add_piece(walk.kind, s, e, 0.0, s < to ? s : to, result);
    add_piece(walk.kind, s, e, s > 0.0 ? s : 0.0, e < to ? e : to, result);
    if (walk.kind == 2) {
        result.coefficient[0] = 0.5 * w * (e + s);
        result.coefficient[1] = -w;
    } else {
        result.coefficient[0] = w * (e * e + e * s + s * s) / 3.0;
        result.coefficient[1] = -w * (e + s);
        result.coefficient[2] = w;
    }
    return result;
}

}  // namespace zlg::core
