#include <zlg/core/compensation/light_spline.hpp>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

constexpr int close_knots = 16;  // half-periods with knots of their own
// Beyond them: each step a fifth to a quarter of the way from the closing.
constexpr int far_knots[] = {20, 24, 28, 34, 40, 48, 58, 70, 84, 104, 128};

// Gauss and Legendre's four points and weights on 0..1: exact for products of cubics.
constexpr double gauss_point[4] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263};
constexpr double gauss_weight[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307, 0.17392742256872693};

// g, in units of P: from next to nothing to a parabola.
constexpr double smoothings[] = {1e-3, 1e-1, 1e1, 1e3, 1e5, 1e7};

// Of the likeliest g so much is taken: a loop that slews or waits has kinks, which the likeliest one rounds off. A dead
// time of a few halves then errs by as much as without (0.3 arcsec at a miss of 0.22), where the likeliest g makes it
// three times that.
constexpr double part_of_likeliest = 0.01;

// g P. Of a cubic between two knots four values give the third derivative.
void add_roughness(const LightBasis& basis, double smoothing, Triangle to) noexcept {
    constexpr double differences[] = {-27.0, 81.0, -81.0, 27.0};
    for (int i = 0; i + 3 < basis.n_terms; ++i) {
        const int start = basis.knot[static_cast<unsigned>(i + 3)];
        const double width = basis.knot[static_cast<unsigned>(i + 4)] - start;
        const BasisSpan span = span_of(basis, start);
        std::array<double, 4> third{};  // times width^3
        for (int k = 0; k < 4; ++k) {
            const std::array<double, 4> value = values_at(span, start + width * k / 3.0);
            for (unsigned a = 0; a < 4; ++a) third[a] += differences[k] * value[a];
        }
        const double since_closing = 1.0 + start + 0.5 * width;
        const double weight = smoothing * square(since_closing) * since_closing / (square(square(width)) * width);
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b <= a; ++b)
                to.row(i + a)[i + b] += weight * third[static_cast<unsigned>(a)] * third[static_cast<unsigned>(b)];
    }
}

int entry(int i, int j) noexcept { return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i; }

}  // namespace

LightBasis light_basis(int halves) noexcept {
    LightBasis basis;
    basis.halves = halves;
    std::size_t n = 3;
    const auto add = [&](int knot) { basis.knot[n++] = static_cast<std::uint8_t>(knot); };
    for (int knot = 0; knot <= close_knots && knot < halves; ++knot) add(knot);
    for (const int knot : far_knots)
        if (knot + 1 < halves) add(knot);
    basis.n_terms = static_cast<int>(n);
    // Four knots in one place end the basis; those at the start are 0 already.
    for (int k = 0; k < 4; ++k) add(halves);
    return basis;
}

BasisSpan span_of(const LightBasis& basis, int h) noexcept {
    BasisSpan span;
    // The knot at or before half h, counted from the first.
    int& i = span.first;
    while (i + 4 < basis.n_terms && basis.knot[static_cast<unsigned>(i + 4)] <= h) ++i;
    for (unsigned k = 0; k < 6; ++k) span.knot[k] = basis.knot[static_cast<unsigned>(span.first) + 1 + k];
    return span;
}

std::array<double, 4> values_at(const BasisSpan& span, double time) noexcept {
    const double* const knot = span.knot.data() + 2;  // at or before the time
    std::array<double, 4> value{1.0, 0.0, 0.0, 0.0};
    // From the constants to the cubics: de Boor's recurrence.
    for (int order = 1; order <= 3; ++order) {
        double carried = 0.0;
        for (int r = 0; r < order; ++r) {
            const double right = knot[r + 1];
            const double left = knot[r + 1 - order];
            const double part = value[static_cast<unsigned>(r)] / (right - left);
            value[static_cast<unsigned>(r)] = carried + (right - time) * part;
            carried = (time - left) * part;
        }
        value[static_cast<unsigned>(order)] = carried;
    }
    return value;
}

void add(LightSums& sums, int h, std::span<const double> detuning_lambda) noexcept {
    const auto n = static_cast<double>(detuning_lambda.size());
    const BasisSpan span = span_of(sums.basis, h);
    double place = 0.5;
    for (const double x : detuning_lambda) {
        const std::array<double, 4> value = values_at(span, h + place / n);
        place += 1.0;
        for (unsigned a = 0; a < 4; ++a) {
            const unsigned i = static_cast<unsigned>(span.first) + a;
            sums.moment[i] += value[a] * x;
            for (unsigned b = 0; b <= a; ++b) sums.normal[4 * i + 3 + b - a] += value[a] * value[b];
        }
        sums.sum_sq += x * x;
    }
    sums.n_samples += static_cast<int>(detuning_lambda.size());
}

bool LightFit::solve(const LightSums& sums, double smoothing, double* reciprocal) noexcept {
    const int n = basis_.n_terms;
    const Triangle factor{covariance_.data()};
    covariance_ = {};
    for (int i = 0; i < n; ++i)
        for (int j = i < 3 ? 0 : i - 3; j <= i; ++j)
            factor.row(i)[j] = sums.normal[static_cast<unsigned>(4 * i + 3 + j - i)];
    if (smoothing > 0.0) add_roughness(basis_, smoothing, factor);
    if (!factorise(factor, reciprocal, n)) return false;
    term_ = sums.moment;
    eliminate(factor, reciprocal, n, term_.data());
    return true;
}

LightFit::LightFit(const LightSums& sums, double light_sd_lambda, const LossBend& bend) noexcept
    : bend_{bend}, basis_{sums.basis} {
    const int n = basis_.n_terms;
    std::array<double, most_light_terms> reciprocal{};
    const auto left_over = [&] { return sums.sum_sq - dot(term_.data(), term_.data(), n); };
    double variance = square(light_sd_lambda);
    if (sums.n_samples > n && solve(sums, 0.0, reciprocal.data())) {
        const double seen = left_over() / (sums.n_samples - n);
        if (seen > variance) variance = seen;
    }
    double likeliest = smoothings[0];
    double most = -infinity;
    for (const double smoothing : smoothings) {
        if (!solve(sums, smoothing, reciprocal.data())) continue;
        const double likelihood =
            log_of_product(reciprocal.data(), n) + 0.5 * (n - 3) * maths::log(smoothing) - 0.5 * left_over() / variance;
        if (!(likelihood > most)) continue;
        most = likelihood;
        likeliest = smoothing;
    }
    if (sums.n_samples < 1 || !solve(sums, part_of_likeliest * likeliest, reciprocal.data())) return;
    known_ = true;
    const Triangle factor{covariance_.data()};
    substitute_back(factor, reciprocal.data(), n, term_.data());
    invert(factor, reciprocal.data(), n);
    for (std::size_t k = 0; k < triangle_size(n); ++k) covariance_[k] *= variance;
}

LightHalf LightFit::half(int h) const noexcept {
    LightHalf half{};
    const BasisSpan span = span_of(basis_, h);
    half.first = span.first;
    for (int k = 0; k < 4; ++k) {
        const std::array<double, 4> value = values_at(span, h + gauss_point[k]);
        const double x = dot(value.data(), term_.data() + half.first, 4);
        const Loss loss = loss_at(bend_, square(x));
        half.value += gauss_weight[k] * loss.value;
        unsigned i = 0;
        for (unsigned a = 0; a < 4; ++a) {
            half.slope[a] += gauss_weight[k] * loss.slope * x * value[a];
            for (unsigned b = 0; b <= a; ++b)
                half.product[i++] += gauss_weight[k] * loss.curvature * value[a] * value[b];
        }
    }
    return half;
}

double LightFit::angle(const LightHalf& half) const noexcept {
    double sum = half.value;
    for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b)
            sum -= half.product[static_cast<unsigned>(entry(a, b))] *
                   covariance_[static_cast<unsigned>(entry(half.first + a, half.first + b))];
    return sum;
}

double LightFit::covariance(const LightHalf& one, const LightHalf& other) const noexcept {
    // S = block of cov c between both; then Q_h S and S Q_g, whose products summed are the trace.
    double linear = 0.0;
    double trace = 0.0;
    double block[4][4];
    for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b)
            block[a][b] = covariance_[static_cast<unsigned>(entry(one.first + a, other.first + b))];
    for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < 4; ++b) {
            double left = 0.0;
            double right = 0.0;
            for (int k = 0; k < 4; ++k) {
                left += one.product[static_cast<unsigned>(entry(a, k))] * block[k][b];
                right += block[a][k] * other.product[static_cast<unsigned>(entry(k, b))];
            }
            trace += left * right;
            linear += one.slope[static_cast<unsigned>(a)] * block[a][b] * other.slope[static_cast<unsigned>(b)];
        }
    }
    return 4.0 * linear + 2.0 * trace;
}

}  // namespace zlg::core
