#include <zlg/calibration/bias_loss.hpp>

#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

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

// The borders of one re-lock with the mean square as the loss per unit of chi.
RelockBorders borders_of(const RelockView& view, const BiasLaw& law, std::size_t transient) {
    const LightNoise light{view.log->square};
    const Eigen::Index n = halves_used(view, transient);
    const auto kept = static_cast<Eigen::Index>(transient + 1);
    Eigen::Index h = 0;
    double noise = 0.0;
    RelockBorders borders =
        relock_borders(view, law, transient, 1, [&](const core::HalfRecord& r, Eigen::Ref<Eigen::RowVectorXd> loss) {
            const double cycles = 0.5 * view.log->tick_s * law.at_hz(r.temperature_c);
            loss[0] = r.detuning_sq_lambda2 - light.square_lambda2;
            // This half stands in all observations behind it: in all rows k > h, and in the rest's means by their
            // share.
            const double rows = static_cast<double>(kept + 2);
            const double behind = h < kept ? static_cast<double>(kept - 1 - h) + 2.0
                                           : 2.0 * static_cast<double>(n - h) / static_cast<double>(n + 1 - kept);
            const double behind_sq = h < kept ? behind : 0.5 * behind * behind;
            noise += light.variance_of(loss[0]) * cycles * cycles * (behind_sq - behind * behind / rows);
            ++h;
        });
    borders.noise = noise;
    return borders;
}

numeric::Estimate chi_of(double chi, double sigma, const BiasLoss& loss) {
    const numeric::Estimate e = numeric::estimated(chi, sigma);
    constexpr double max_chi2_per_dof = 1000.0;
    if (e.determined && !(loss.chi2_per_dof <= max_chi2_per_dof))
        return numeric::refused(
            fmt::format("chi = {:.2g} +- {:.2g}: the residuals are {:.3g} times what rounding and light noise make, "
                        "allowed is up to {:g}; a gyro at rest would tell",
                        chi, sigma, loss.chi2_per_dof, max_chi2_per_dof));
    constexpr double min_sigma = 0.1;
    constexpr double within_sigmas = 2.0;
    if (e.determined && std::abs(chi) < within_sigmas * sigma && sigma <= min_sigma)
        return numeric::refused(fmt::format("chi = {:.2g} +- {:.2g}: within its error of 0", chi, sigma));
    if (e.determined && chi < -within_sigmas * sigma)
        return numeric::refused(
            fmt::format("chi = {:.2g} +- {:.2g}: the bias does not fall with the detuning", chi, sigma));
    if (!e.determined || (sigma <= min_sigma && chi > 0.0) || sigma <= 0.3 * chi) return e;
    return numeric::refused(
        fmt::format("chi = {:.2g} +- {:.2g} from {} re-locks whose first half lacks {:.2g} counts; more "
                    "switches or a larger miss would tell",
                    chi, sigma, loss.n_relocks, loss.deficit_counts));
}

// A counter that shows one and the same number after every re-lock gives the counts that the first half lacks to about
// a count, over how often it could have shown another. Here the deficit is that of chi = 1.
double resolution(const BiasLoss& loss) {
    return std::sqrt(rounding_counts2) / (loss.deficit_counts * static_cast<double>(1 + loss.n_relocks));
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

void solve(const std::vector<RelockBorders>& all, BiasLoss& loss) {
    const LossFit fit = fit_losses(all, numeric::Laws::distinct);
    loss.chi2_per_dof = fit.chi2_per_dof;
    const double factor = numeric::widened(1.0, static_cast<double>(loss.n_relocks) - 2.0);
    const double variance = loss.n_relocks >= min_relocks_of_loss
                                ? factor * factor * fit.covariance(0, 0) + fit.repeated_covariance(0, 0)
                                : std::fmax(1.0, loss.chi2_per_dof) * rounding_counts2 * fit.inverse(0, 0);
    const double sigma = std::fmax(std::sqrt(variance), resolution(loss));
    loss.deficit_counts *= std::abs(fit.coefficient[0]);
    loss.chi = chi_of(fit.coefficient[0], sigma, loss);
}

}  // namespace

BiasLoss find_bias_loss(std::span<const LabLog> logs, const BiasLaw& law) {
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
        std::vector<RelockBorders> all;
        for (const RelockView& view : relocks.views) {
            all.push_back(borders_of(view, law, relocks.transient_halves));
            loss.deficit_counts += 0.5 * view.log->tick_s * law.bias_hz.value * relocks.first_square_lambda2 /
                                   static_cast<double>(relocks.views.size());
        }
        solve(all, loss);
    }
    return loss;
}

}  // namespace zlg::calibration
