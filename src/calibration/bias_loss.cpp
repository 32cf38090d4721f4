#include <zlg/calibration/bias_loss.hpp>

#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "relock_borders.hpp"

namespace zlg::calibration {
namespace {

// What light noise does to the mean square of a half, seen on the settled gyro.
struct LightNoise {
    double square_lambda2 = 0.0;    // mean square of the settled gyro: the variance of one sample
    double variance_lambda4 = 0.0;  // scatter of that mean square from half to half

    explicit LightNoise(const Moments& settled) : square_lambda2{settled.mean}, variance_lambda4{settled.variance()} {}

    // Variance of a mean square that is `excess` above the settled one: with n samples 2 s^4/n + 4 dl^2 s^2/n.
    [[nodiscard]] double variance_of(double excess_lambda2) const {
        if (!(square_lambda2 > 0.0)) return 0.0;
        return variance_lambda4 * (1.0 + 2.0 * std::fmax(excess_lambda2, 0.0) / square_lambda2);
    }
};

// So many clusters give a scatter to be relied on.
constexpr std::int64_t min_relocks_of_loss = 8;
constexpr std::int64_t min_relocks_of_powers = 20;

// Further powers of the detuning are looked for where the residuals are more than this times rounding and light noise,
// and must be told from 0 by so many standard deviations.
constexpr double good_chi2_per_dof = 2.0;
constexpr double min_sigmas = 5.0;
// Of the variance of rounding: a counter at rest that repeats itself more than this tells one coefficient, not many.
constexpr double max_repeated_ratio = 0.5;

// The borders of one re-lock with the mean square as the loss per unit of chi, and with the means of its `n_laws` - 1
// next powers, each over that of the mean square of the first half.
RelockBorders borders_of(const RelockView& view, const BiasLaw& law, const Relocks& relocks, Eigen::Index n_laws) {
    const LightNoise light{view.log->square};
    const Eigen::Index n = halves_used(view, relocks.transient_halves);
    const auto kept = static_cast<Eigen::Index>(relocks.transient_halves + 1);
    Eigen::Index h = 0;
    const double unit_lambda2 = relocks.first_square_lambda2;
    Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(n_laws, n_laws);
    Eigen::VectorXd slope = Eigen::VectorXd::Ones(n_laws);  // of the columns by the mean square
    const auto losses = [&](const core::HalfRecord& r, Eigen::Ref<Eigen::RowVectorXd> loss) {
        const double cycles = 0.5 * view.log->tick_s * law.at_hz(r.temperature_c);
        loss[0] = r.detuning_sq_lambda2 - light.square_lambda2;
        const double variance = light.variance_of(loss[0]);
        const Groups x{r, light.square_lambda2};
        const double above = square(x.above) / unit_lambda2, below = square(x.below) / unit_lambda2;
        const double mean = std::fmax(loss[0], 0.0) / unit_lambda2;
        for (Eigen::Index k = 1; k < n_laws; ++k) {
            const auto power = static_cast<double>(k + 1);
            slope[k] = power * std::pow(mean, k);
            loss[k] = 0.5 * unit_lambda2 * (std::pow(above, k + 1) + std::pow(below, k + 1)) -
                      0.5 * power * (power - 1.0) * std::pow(mean, k - 1) * variance / unit_lambda2;
        }
        // This half stands in all observations behind it: in all rows k > h, and in the rest's means by their share.
        const double rows = static_cast<double>(kept + 2);
        const double behind = h < kept ? static_cast<double>(kept - 1 - h) + 2.0
                                       : 2.0 * static_cast<double>(n - h) / static_cast<double>(n + 1 - kept);
        const double behind_sq = h < kept ? behind : 0.5 * behind * behind;
        noise += variance * cycles * cycles * (behind_sq - behind * behind / rows) * slope * slope.transpose();
        ++h;
    };
    RelockBorders borders = relock_borders(view, law, relocks.transient_halves, n_laws, losses);
    borders.noise = noise;
    return borders;
}

numeric::Estimate chi_of(double chi, double sigma, double rounding, const BiasLoss& loss) {
    const numeric::Estimate e = numeric::estimated(chi, sigma);
    constexpr double max_chi2_per_dof = 1000.0;
    if (e.determined && !(loss.chi2_per_dof * rounding <= max_chi2_per_dof * rounding_counts2))
        return numeric::refused(
            fmt::format("chi = {:.2g} +- {:.2g}: the residuals are {:.3g} times what rounding and light noise make, "
                        "allowed is up to {:g}; a gyro at rest would tell",
                        chi, sigma, loss.chi2_per_dof, max_chi2_per_dof));
    // The gases of lasers make -5 to 8 of it, 3 about what would be presumed: nearer than that is better, whatever the
    // sign. Of several coefficients the others have been told from 0.
    constexpr double max_sigma = 3.0;
    if (!e.determined || sigma <= std::fmax(max_sigma, 0.3 * std::abs(chi)) || !loss.higher.empty()) return e;
    return numeric::refused(
        fmt::format("chi = {:.2g} +- {:.2g} from {} re-locks whose first half lacks {:.2g} counts; more "
                    "switches or a larger miss would tell",
                    chi, sigma, loss.n_relocks, loss.deficit_counts));
}

// A counter that shows one and the same number after every re-lock gives the counts that the first half lacks to about
// a count, over how often it could have shown another. Here the deficit is that of chi = 1.
double resolution(const BiasLoss& loss, double rounding) {
    return std::sqrt(rounding) / (loss.deficit_counts * static_cast<double>(1 + loss.n_relocks));
}

// Why chi cannot follow from the column; empty where it may.
std::string why_useless(const Relocks& relocks) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const RelockView& view : relocks.views) {
        for (const core::HalfRecord& r : view.relock->halves) {
            least = std::fmin(least, r.detuning_sq_lambda2);
            most = std::fmax(most, r.detuning_sq_lambda2);
        }
    }
    constexpr double max_square_lambda2 = 1e6;
    if (!(least >= 0.0 && most <= max_square_lambda2))
        return fmt::format("the column detuning_sq_lambda2 reaches from {:.3g} to {:.3g}; allowed is 0..{:g} lambda^2",
                           least, most, max_square_lambda2);
    if (!(most - least > 1e-9 * most))
        return fmt::format("the column detuning_sq_lambda2 is constant, {:.3g}: no re-lock shows in it", least);
    return {};
}

LossFit fit_of(const Relocks& relocks, const BiasLaw& law, Eigen::Index n_laws) {
    std::vector<RelockBorders> all;
    for (const RelockView& view : relocks.views) all.push_back(borders_of(view, law, relocks, n_laws));
    return fit_losses(all, numeric::Laws::distinct);
}

// Mean over the powers from `first` on: their square over its covariance (Wald's test).
double added_sigmas2(const LossFit& fit, Eigen::Index first) {
    const Eigen::Index n = fit.coefficient.size() - 1 - first;
    const Eigen::VectorXd added = fit.coefficient.segment(first, n);
    const Eigen::MatrixXd covariance = (fit.covariance + fit.repeated_covariance).block(first, first, n, n);
    return added.dot(covariance.ldlt().solve(added)) / static_cast<double>(n);
}

// By as few powers as do.
LossFit best_fit(const Relocks& relocks, const BiasLaw& law, Eigen::Index max_laws) {
    LossFit best = fit_of(relocks, law, 1);
    if (!relocks.has_detunings() || best.repeated_ratio > max_repeated_ratio) return best;
    if (std::ssize(relocks.views) < min_relocks_of_powers) return best;
    for (Eigen::Index n = 2; n <= max_laws && best.chi2_per_dof > good_chi2_per_dof; ++n) {
        LossFit fit = fit_of(relocks, law, n);
        if (added_sigmas2(fit, best.coefficient.size() - 1) > square(min_sigmas)) best = std::move(fit);
    }
    return best;
}

void solve(const Relocks& relocks, const BiasLaw& law, Eigen::Index max_laws, BiasLoss& loss) {
    const LossFit fit = best_fit(relocks, law, max_laws);
    for (Eigen::Index k = 1; k + 1 < fit.coefficient.size(); ++k)
        loss.higher.push_back(fit.coefficient[k] / std::pow(relocks.first_square_lambda2, k));
    loss.chi2_per_dof = fit.chi2_per_dof;
    const double factor = numeric::widened(1.0, static_cast<double>(loss.n_relocks) - 2.0);
    const double variance = loss.n_relocks >= min_relocks_of_loss
                                ? factor * factor * fit.covariance(0, 0) + fit.repeated_covariance(0, 0)
                                : std::fmax(1.0, loss.chi2_per_dof) * fit.rounding * fit.inverse(0, 0);
    const double sigma = std::fmax(std::sqrt(variance), resolution(loss, fit.rounding));
    loss.deficit_counts *= std::abs(fit.coefficient[0]);
    loss.chi = chi_of(fit.coefficient[0], sigma, fit.rounding, loss);
}

}  // namespace

BiasLoss find_bias_loss(std::span<const LabLog> logs, const BiasLaw& law, int max_powers) {
    BiasLoss loss;
    const Relocks relocks{logs};
    loss.n_relocks = std::ssize(relocks.views);
    if (!law.bias_hz.determined) {
        loss.chi = numeric::refused("the bias frequency is not determined");
    } else if (relocks.views.empty()) {
        loss.chi =
            numeric::refused(fmt::format("no gap is followed by {} measured ticks with the column detuning_sq_lambda2",
                                         settled_after_ticks + block_ticks));
    } else if (const std::string useless = why_useless(relocks); !useless.empty()) {
        loss.n_relocks = 0;
        loss.chi = numeric::refused(useless);
    } else {
        for (const RelockView& view : relocks.views)
            loss.deficit_counts += 0.5 * view.log->tick_s * law.bias_hz.value * relocks.first_square_lambda2 /
                                   static_cast<double>(relocks.views.size());
        solve(relocks, law, max_powers, loss);
    }
    return loss;
}

}  // namespace zlg::calibration
