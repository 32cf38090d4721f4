#include "accuracy_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace zlg::trials {
namespace {

struct Sums {
    double plain = 0.0, with_sign = 0.0, squares = 0.0, normed = 0.0;
    std::int64_t within = 0;
};

void claim(const SwitchError& e, ErrorFigures& f, Sums& sums) {
    if (!std::isfinite(e.sigma_arcsec) || !(e.sigma_arcsec > 0.0)) return;
    const double ratio = e.error_arcsec / e.sigma_arcsec;
    sums.normed += ratio * ratio;
    sums.within += std::abs(ratio) <= 3.0;
    ++f.claimed;
}

void conclude(const Sums& sums, ErrorFigures& f) {
    if (f.n == 0) return;
    const auto n = static_cast<double>(f.n);
    f.mean_arcsec = sums.plain / n;
    f.bias_arcsec = sums.with_sign / n;
    f.rms_arcsec = std::sqrt(sums.squares / n);
    f.sd_arcsec = std::sqrt(std::max(0.0, sums.squares / n - f.bias_arcsec * f.bias_arcsec));
    f.standard_error = f.sd_arcsec / std::sqrt(n);
    if (f.claimed == 0) return;
    f.nev = sums.normed / static_cast<double>(f.claimed);
    f.within_3_sigma_ratio = static_cast<double>(sums.within) / static_cast<double>(f.claimed);
}

}  // namespace

ErrorFigures figures_of(const std::vector<SwitchError>& errors) {
    ErrorFigures f;
    Sums sums;
    for (const SwitchError& e : errors) {
        ++f.n;
        sums.plain += e.error_arcsec;
        sums.with_sign += e.sign * e.error_arcsec;
        sums.squares += e.error_arcsec * e.error_arcsec;
        f.worst_arcsec = std::max(f.worst_arcsec, std::abs(e.error_arcsec));
        claim(e, f, sums);
    }
    conclude(sums, f);
    return f;
}

ErrorFigures relock_figures_of(const std::vector<SwitchError>& errors) {
    std::vector<SwitchError> alone = errors;
    for (SwitchError& e : alone) {
        e.error_arcsec = e.relock_error_arcsec;
        e.sigma_arcsec = 0.0;
    }
    return figures_of(alone);
}

}  // namespace zlg::trials
