// Errors of the core's elementary functions in units in the last place, with MPFR as the judge.

#include "errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace zlg::trials {
namespace {

constexpr mpfr_prec_t precision_bits = 96;  // the judge errs by 2^-43 units in the last place

class Number {
public:
    explicit Number(mpfr_prec_t bits) { mpfr_init2(value_, bits); }
    ~Number() { mpfr_clear(value_); }
    Number(const Number&) = delete;
    Number& operator=(const Number&) = delete;
    operator mpfr_ptr() { return value_; }

private:
    mpfr_t value_;
};

// An infinity counts as 2^1024, which is what would come after the largest double.
double ulps(double got, mpfr_ptr exact, mpfr_ptr difference) {
    constexpr int least_exponent = -1074;
    if (std::isnan(got) || mpfr_nan_p(exact)) return std::numeric_limits<double>::infinity();
    if (std::isinf(got)) {
        mpfr_set_si_2exp(difference, got > 0.0 ? 1 : -1, 1024, MPFR_RNDN);
        if (mpfr_cmpabs(exact, difference) >= 0 && std::signbit(got) == (mpfr_signbit(exact) != 0)) return 0.0;
        mpfr_sub(difference, difference, exact, MPFR_RNDN);
    } else {
        mpfr_d_sub(difference, got, exact, MPFR_RNDN);
    }
    if (mpfr_zero_p(difference)) return 0.0;
    const auto exponent = mpfr_zero_p(exact) ? -1074 : static_cast<int>(std::clamp(mpfr_get_exp(exact), -2000L, 1024L));
    mpfr_mul_2si(difference, difference, -std::max(exponent - 53, least_exponent), MPFR_RNDN);
    return std::fabs(mpfr_get_d(difference, MPFR_RNDN));
}

}  // namespace

WorstError worst_error(const Region& region, int n_points) {
    Number x{53};
    Number y{53};
    Number exact{precision_bits};
    Number difference{precision_bits};
    Bits bits{1};
    WorstError worst;
    for (int k = 0; k < n_points; ++k) {
        const Arguments at = region.draw(bits);
        mpfr_set_d(x, at.x, MPFR_RNDN);
        mpfr_set_d(y, at.y, MPFR_RNDN);
        region.function.exact(exact, x, y);
        const double error = ulps(region.function.computed(at), exact, difference);
        if (error > worst.ulps) worst = {error, at};
    }
    return worst;
}

}  // namespace zlg::trials
