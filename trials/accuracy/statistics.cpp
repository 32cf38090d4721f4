#include "parts.hpp"

#include <algorithm>
#include <cmath>

namespace zlg::trials {

ErrorFigures figures_of(const std::vector<SwitchError>& errors) {
    ErrorFigures f{.n = static_cast<std::int64_t>(errors.size())};
    if (errors.empty()) return f;
    double fourth_powers = 0.0;
    for (const SwitchError& e : errors) {
        f.bias_arcsec += e.sign * e.error_arcsec;
        f.rms_arcsec += e.error_arcsec * e.error_arcsec;
        f.worst_arcsec = std::max(f.worst_arcsec, std::abs(e.error_arcsec));
        if (!std::isfinite(e.sigma_arcsec) || !(e.sigma_arcsec > 0.0)) continue;
        const double ratio = e.error_arcsec / e.sigma_arcsec;
        f.nev += ratio * ratio;
        fourth_powers += ratio * ratio * ratio * ratio;
        f.within_3_sigma_ratio += std::abs(ratio) <= 3.0 ? 1.0 : 0.0;
        ++f.claimed;
    }
    const auto n = static_cast<double>(f.n);
    f.bias_arcsec /= n;
    const double mean_square = f.rms_arcsec / n;
    f.rms_arcsec = std::sqrt(mean_square);
    f.sd_arcsec = std::sqrt(std::max(0.0, mean_square - f.bias_arcsec * f.bias_arcsec));
    f.standard_error = f.sd_arcsec / std::sqrt(n);
    if (f.claimed == 0) return f;
    const auto claimed = static_cast<double>(f.claimed);
    f.nev /= claimed;
    f.nev_standard_error = std::sqrt(std::max(0.0, fourth_powers / claimed - f.nev * f.nev) / claimed);
    f.within_3_sigma_ratio /= claimed;
    return f;
}

}  // namespace zlg::trials
