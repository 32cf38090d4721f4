#include <zlg/calibration/loss_curve.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "relock_borders.hpp"

namespace zlg::calibration {
namespace {

constexpr double max_chi2_per_dof = 1000.0;
constexpr Eigen::Index n_terms = 4;
constexpr std::int64_t min_relocks_of_curve = 20;
constexpr int n_points = 24;
constexpr double min_bend_sigmas = 6.0;
constexpr double min_bend_ratio = 0.05;
// Of the variance of rounding: a counter at rest that repeats itself more than this gives a few numbers, not many.
constexpr double max_repeated_ratio = 0.5;
// Of the loss at any point beyond a quarter of the last: a curve that is worse than this is none.
constexpr double max_uncertainty_ratio = 0.1;
// What one term less makes of a point, of this part of that the point itself may be wrong.
constexpr double uncertainty_of_terms = 0.3;
// x0 over the last point.
constexpr std::array<double, 14> places{0.06, 0.08, 0.1, 0.13, 0.16, 0.2, 0.25, 0.32, 0.4, 0.5, 0.64, 0.8, 1.0, 1.3};

using Terms = Eigen::Matrix<double, n_terms, 1>;

Terms terms(double x, double x0) {
    const double fall = 1.0 / (1.0 + square(x / x0));
    Terms t;
    t[0] = square(x);
    for (Eigen::Index k = 1; k < n_terms; ++k) t[k] = t[k - 1] * fall;
    return t;
}

struct Fit : LossFit {
    double x0 = 0.0;

    [[nodiscard]] Eigen::Index n() const { return coefficient.size() - 1; }
    [[nodiscard]] double loss(double x) const { return terms(x, x0).head(n()).dot(coefficient.head(n())); }
    [[nodiscard]] double chi() const { return coefficient.head(n()).sum(); }
    [[nodiscard]] double loss_sigma(double x) const {
        const Eigen::VectorXd t = terms(x, x0).head(n());
        return std::sqrt(t.dot(covariance.topLeftCorner(n(), n()) * t));
    }
};

std::vector<RelockBorders> borders_of(const Relocks& relocks, const BiasLaw& law, Eigen::Index n_laws, double x0) {
    std::vector<RelockBorders> all;
    for (const RelockView& view : relocks.views) {
        const double noise_lambda2 = view.log->square.mean;
        all.push_back(relock_borders(view, law, relocks.transient_halves, n_laws,
                                     [&](const core::HalfRecord& r, Eigen::Ref<Eigen::RowVectorXd> loss) {
                                         const Groups x{r, noise_lambda2};
                                         const Terms mean = 0.5 * (terms(x.above, x0) + terms(x.below, x0));
                                         loss = mean.head(n_laws).transpose();
                                     }));
    }
    return all;
}

Fit best_fit(const Relocks& relocks, const BiasLaw& law, Eigen::Index n_laws, double farthest_lambda) {
    Fit best;
    best.residual = std::numeric_limits<double>::infinity();
    for (const double place : places) {
        const double x0 = place * farthest_lambda;
        LossFit fit = fit_losses(borders_of(relocks, law, n_laws, x0), numeric::Laws::alike);
        fit.covariance += fit.repeated_covariance;
        if (fit.residual < best.residual) best = {std::move(fit), x0};
    }
    return best;
}

// What a fifth of the re-locks exceed.
double farthest_lambda(const Relocks& relocks) {
    std::vector<double> farthest;
    for (const RelockView& view : relocks.views) {
        double most = 0.0;
        for (std::size_t h = 0; h < relocks.transient_halves; ++h)
            most = std::fmax(most, Groups{view.relock->halves[h], view.log->square.mean}.farthest());
        farthest.push_back(most);
    }
    std::ranges::sort(farthest, std::greater{});
    return farthest[farthest.size() / 5];
}

// How far the loss over the square of the detuning falls from a third of the last point to that point.
struct Bend {
    double ratio;  // of its value at a third
    double in_sigmas;

    Bend(const Fit& fit, double last_lambda) {
        const double third = last_lambda / 3.0;
        const Eigen::VectorXd at_third = terms(third, fit.x0).head(fit.n()) / square(third);
        const Eigen::VectorXd fall = terms(last_lambda, fit.x0).head(fit.n()) / square(last_lambda) - at_third;
        const Eigen::VectorXd c = fit.coefficient.head(fit.n());
        const double variance = fall.dot(fit.covariance.topLeftCorner(fit.n(), fit.n()) * fall);
        ratio = std::abs(fall.dot(c) / at_third.dot(c));
        in_sigmas = std::abs(fall.dot(c)) / std::sqrt(variance);
    }
};

// Why the fit is no curve; empty where it is one.
std::string fault_of(const Fit& fit, double last_lambda) {
    if (!(fit.chi2_per_dof <= max_chi2_per_dof))
        return fmt::format("the residuals of the re-locks are {:.3g} times what rounding makes, allowed is up to {:g}",
                           fit.chi2_per_dof, max_chi2_per_dof);
    if (fit.repeated_ratio > max_repeated_ratio)
        return "the counter rounds alike after every switch; a slow rotation at a known rate would tell";
    const Bend bend{fit, last_lambda};
    if (!(bend.ratio > min_bend_ratio && bend.in_sigmas > min_bend_sigmas))
        return fmt::format("up to {:.3g} logged wavelengths the loss of bias does not tell it from a straight line",
                           last_lambda);
    if (!(fit.chi() > 0.0)) return "the loss of bias at small detunings is lost in the rounding of the counter";
    return {};
}

void add_points(const Fit& fit, const Fit& coarse, double last_lambda, LossCurve& found) {
    const double chi = fit.chi();
    double before = 0.0;
    for (int k = 1; k <= n_points; ++k) {
        // Closest at small detunings, where a parabola is all there is to see.
        const double x = last_lambda * std::pow(static_cast<double>(k) / n_points, 1.5);
        const double loss = fit.loss(x);
        const double detuning = std::sqrt(loss / chi);
        const double uncertainty =
            std::hypot(fit.loss_sigma(x), uncertainty_of_terms * (fit.loss(x) - coarse.loss(x))) / loss;
        if (!(detuning > before)) {
            found.reason = fmt::format("the loss of bias does not grow with the logged detuning at {:.3g}", x);
            return;
        }
        if (x > 0.25 * last_lambda && !(uncertainty < max_uncertainty_ratio)) {
            found.reason = fmt::format(
                "the loss of bias at a logged detuning of {:.3g} is known to {:.2g} of it only; "
                "more switches would tell",
                x, uncertainty);
            return;
        }
        before = detuning;
        found.logged_lambda.push_back(x);
        found.detuning_lambda.push_back(detuning);
        found.sigma_lambda.push_back(0.5 * uncertainty * detuning);
    }
    found.curve = core::discriminator_curve(found.logged_lambda, found.detuning_lambda);
    found.determined = check(found.curve) == core::CurveFault::none;
    if (!found.determined) found.reason = "its points make no curve that grows";
}

LossCurve refused_curve(std::string reason) {
    LossCurve curve;
    curve.reason = std::move(reason);
    return curve;
}

}  // namespace

LossCurve find_loss_curve(std::span<const LabLog> logs, const BiasLaw& law) {
    if (!law.bias_hz.determined) return refused_curve("the bias frequency is not determined");
    const Relocks relocks{logs};
    const std::int64_t n = std::ssize(relocks.views);
    if (n < min_relocks_of_curve || !relocks.has_detunings())
        return refused_curve(
            fmt::format("{} re-locks with the columns detuning_lambda and detuning_sq_lambda2; {} or more are needed",
                        relocks.has_detunings() ? n : 0, min_relocks_of_curve));
    const double last_lambda = farthest_lambda(relocks);
    if (!(last_lambda > 0.0 && last_lambda < 1e3)) return refused_curve("no re-lock shows in the detuning");
    const Fit fit = best_fit(relocks, law, n_terms, last_lambda);
    LossCurve found;
    found.n_relocks = n;
    found.chi2_per_dof = fit.chi2_per_dof;
    found.reason = fault_of(fit, last_lambda);
    if (found.reason.empty()) add_points(fit, best_fit(relocks, law, n_terms - 1, last_lambda), last_lambda, found);
    return found;
}

std::vector<LabLog> straightened(std::span<const LabLog> logs, const LossCurve& found) {
    std::vector<LabLog> straight{logs.begin(), logs.end()};
    const auto f = [&found](double x) { return core::true_detuning(found.curve, x).detuning_lambda; };
    for (LabLog& log : straight) {
        for (Relock& relock : log.relocks) {
            for (core::HalfRecord& r : relock.halves) {
                const Groups x{r, log.square.mean};
                r.detuning_lambda = 0.5 * (f(x.above) + f(x.below));
                r.detuning_sq_lambda2 +=
                    0.5 * (square(f(x.above)) - square(x.above) + square(f(x.below)) - square(x.below));
            }
        }
    }
    return straight;
}

}  // namespace zlg::calibration
