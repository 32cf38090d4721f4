#include <zlg/calibration/drift_law.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include <zlg/calibration/increment_fit.hpp>

#include <zlg/numeric/minimum.hpp>
#include "pieces.hpp"

namespace zlg::calibration {
namespace {

constexpr std::int64_t min_pieces = 8;   // twice the coefficients of the law with its tau
constexpr double wanted_pieces = 500.0;  // a fit costs their number, more add nothing to a law this smooth
// Counts between the borders of a piece: the fraction of the count at a border is then as good as uniform and
// independent.
constexpr double turned_between = 2.0;
constexpr double min_bend_sigmas = 4.0;  // of A, and of a straight growth
constexpr double max_time_error = 0.2;   // of tau, relative

// Pieces so long that the counter turns on meanwhile: the readings at their borders are then rounded independently.
std::vector<Piece> turning_pieces(std::span<const LabLog> logs) {
    double turned_counts = 0.0;
    for (const Piece& segment : pieces_of(logs, std::numeric_limits<double>::infinity()))
        turned_counts += std::abs(segment.counts);
    const double all_s = settled_s(logs);
    return pieces_of(logs, std::max(all_s / wanted_pieces, turned_between * all_s / std::max(turned_counts, 1.0)));
}

// Counts that a tick lacks while the bias grows with temperature, for the half that comes second has more of it:
// s (T/4) df/dt a second. They follow the helicity as a magnetic drift does, and are put back.
double counts_of_warming(const Piece& p, const BiasLaw& bias, double tick_s) {
    if (!bias.bias_hz.determined || !std::isfinite(p.signed_rise_c)) return 0.0;
    return 0.25 * tick_s * bias.slope_hz_per_c(p.temperature_c) * p.signed_rise_c;
}

// Angles and their laws.
struct Record {
    std::vector<Piece> pieces;
    std::vector<Increment> angles;
    double border_variance;
    double span_s = 0.0;     // longest log
    double segment_s = 0.0;  // longest settled record between two switches

    Record(std::span<const LabLog> logs, double scale_arcsec, double rate_arcsec_s, const BiasLaw& bias)
        : pieces{turning_pieces(logs)}, border_variance{scale_arcsec * scale_arcsec / 12.0} {
        for (const Piece& p : pieces) {
            const double counts = p.counts + counts_of_warming(p, bias, logs[p.log].tick_s);
            angles.push_back({scale_arcsec * counts - rate_arcsec_s * p.length_s, p.length_s, p.chain});
            span_s = std::max(span_s, p.start_s + p.length_s);
        }
        for (const Piece& p : pieces_of(logs, std::numeric_limits<double>::infinity()))
            segment_s = std::max(segment_s, p.length_s);
    }

    [[nodiscard]] Eigen::Index n() const { return std::ssize(pieces); }

    // Columns: constant of either kind, then `extra` of a piece.
    template <class Extra> [[nodiscard]] Eigen::MatrixXd laws(Eigen::Index n_extra, Extra extra) const {
        Eigen::MatrixXd m(n(), 2 + n_extra);
        for (Eigen::Index p = 0; p < n(); ++p) {
            const Piece& piece = pieces[static_cast<std::size_t>(p)];
            m(p, 0) = piece.mode * piece.length_s;
            m(p, 1) = piece.length_s;
            extra(piece, m.row(p));
        }
        return m;
    }
};

// Integral of 1 - exp(-t/tau) over a piece, and its derivative by tau.
struct Warming {
    double integral_s;
    double by_tau;

    Warming(const Piece& p, double tau_s) {
        const double from = std::exp(-p.start_s / tau_s);
        const double loss = std::expm1(-p.length_s / tau_s);
        const double to = from * (1.0 + loss);
        integral_s = p.length_s + tau_s * from * loss;
        by_tau = from * loss - from * p.start_s / tau_s + to * (p.start_s + p.length_s) / tau_s;
    }
};

Eigen::MatrixXd exponential_laws(const Record& record, double tau_s) {
    return record.laws(1, [&](const Piece& p, auto row) { row(2) = p.mode * Warming{p, tau_s}.integral_s; });
}

Eigen::MatrixXd exponential_laws_and_tau(const Record& record, double tau_s, double a_arcsec_s) {
    return record.laws(2, [&](const Piece& p, auto row) {
        const Warming w{p, tau_s};
        row(2) = p.mode * w.integral_s;
        row(3) = p.mode * a_arcsec_s * w.by_tau;
    });
}

Eigen::MatrixXd straight_laws(const Record& record) {
    return record.laws(1,
                       [](const Piece& p, auto row) { row(2) = p.mode * p.length_s * (p.start_s + 0.5 * p.length_s); });
}

double sigma(const IncrementFit& fit, Eigen::Index k) { return std::sqrt(fit.covariance(k, k)); }

struct Exponential {
    double tau_s = 0.0;
    IncrementFit fit;  // Om0, Om_nm, A, tau
    bool determined = false;
};

// Separable nonlinear least squares (Golub and Pereyra, SIAM J. Numer. Anal. 10, 1973): the residual as a function of
// log tau alone, for the other coefficients follow linearly. It is scanned from 1/300 of the longest log, where the
// bend is over within the first few pieces, to 10 times it, where the growth is straight. Each of three rounds finds
// the walk again at the tau found.
Exponential fit_exponential(const Record& record) {
    Exponential e;
    double walk = fit_walk(record.angles, straight_laws(record), record.border_variance).walk_variance_per_s;
    for (int round = 0; round < 3; ++round) {
        const auto residual = [&](double log_tau) {
            const Eigen::MatrixXd laws = exponential_laws(record, std::exp(log_tau));
            return fit_known(record.angles, laws, record.border_variance, walk).residual;
        };
        const double low = std::log(record.span_s / 300.0);
        const double high = std::log(record.span_s * 10.0);
        e.tau_s = std::exp(numeric::scanned_minimum(residual, low, high, 50).at);
        const Eigen::MatrixXd flat = exponential_laws(record, e.tau_s);
        const double a = fit_known(record.angles, flat, record.border_variance, walk).coefficient[2];
        e.fit = fit_walk(record.angles, exponential_laws_and_tau(record, e.tau_s, a), record.border_variance);
        walk = e.fit.walk_variance_per_s;
    }
    // The column of tau corrects by less than its tolerance: coefficient 3 is a step of tau.
    e.tau_s += std::clamp(e.fit.coefficient[3], -0.01 * e.tau_s, 0.01 * e.tau_s);
    e.determined = std::abs(e.fit.coefficient[2]) > min_bend_sigmas * sigma(e.fit, 2) &&
                   sigma(e.fit, 3) < max_time_error * e.tau_s;
    return e;
}

void refuse_thermal(const std::string& reason, DriftLaw& law) {
    law.magnetic_thermal_arcsec_s = numeric::refused(reason);
    law.thermal_time_s = numeric::refused(reason);
}

void refuse_all(const std::string& reason, DriftLaw& law) {
    law.magnetic_arcsec_s = numeric::refused(reason);
    law.nonmagnetic_arcsec_s = numeric::refused(reason);
    law.sensitivity_arcsec_s_g = law.sensitivity_per_c = numeric::refused(reason);
    law.random_walk_arcsec_sqrt_s = numeric::refused(reason);
    refuse_thermal(reason, law);
}

// Rounding is white where the counter turns on between the ends of the segments; a counter that stands rounds in its
// own way, which only a walk beyond the rounding outgrows.
bool walk_shows(const Record& record, double walk) {
    constexpr double turning_counts = 10.0;
    double chains = 0.0;
    double turned_counts = 0.0;
    double length_s = 0.0;
    for (std::size_t p = 0; p < record.pieces.size(); ++p) {
        chains += p == 0 || record.pieces[p].chain != record.pieces[p - 1].chain ? 1.0 : 0.0;
        turned_counts += std::abs(record.pieces[p].counts);
        length_s += record.pieces[p].length_s;
    }
    const double rounding = 2.0 * record.border_variance;
    return walk * length_s / chains > (turned_counts / chains > turning_counts ? 0.5 : 1.0) * rounding;
}

void take(const Record& record, const IncrementFit& fit, DriftLaw& law) {
    law.magnetic_arcsec_s = numeric::estimated(fit.coefficient[0], sigma(fit, 0));
    law.nonmagnetic_arcsec_s = numeric::estimated(fit.coefficient[1], sigma(fit, 1));
    law.chi2_per_dof = fit.residual / static_cast<double>(fit.dof);
    law.dof = fit.dof;
    const double walk = std::sqrt(fit.walk_variance_per_s);
    const double walk_sigma = fit.walk_variance_sigma / (2.0 * walk);
    // Below the rounding the estimate scatters widely; a large one by chance must not be reported. What counts is
    // therefore its lower bound of two standard deviations.
    const double surely = fit.walk_variance_per_s - 2.0 * fit.walk_variance_sigma;
    if (walk_sigma < 0.3 * walk && walk_shows(record, surely))
        law.random_walk_arcsec_sqrt_s = numeric::estimated(walk, walk_sigma);
    else
        law.random_walk_arcsec_sqrt_s = numeric::refused(
            "rounding of the counter hides it; a longer record, or longer segments between switches, would tell");
}

// Why A and tau cannot be separated, or not be found at all.
std::string why_no_bend(const Record& record, const IncrementFit& straight) {
    const double slope = straight.coefficient[2];
    if (!(std::abs(slope) > min_bend_sigmas * sigma(straight, 2)))
        return fmt::format("over {:.4g} s the magnetic drift does not change by more than its error", record.span_s);
    return fmt::format(
        "over {:.4g} s the magnetic drift grows by {:.3g} +- {:.2g} arcsec/s in 1000 s; where it ends is not seen, so "
        "only A/tau is",
        record.span_s, 1e3 * slope, 1e3 * sigma(straight, 2));
}

// Om0 and Om_nm where A and tau are not known: the mean over all warmings from two segments on, for a quicker one is
// over before both modes were seen, to 10 times the span, each weighted by how well it fits, with the spread between
// them. The prior of log tau is the reference prior beside an unknown A (Bernardo and Smith, Bayesian Theory, 1994):
// the speed at which the direction of the law, without the constants, turns. Its square is the information of log tau
// at A = 1 times the variance of A at a known tau. So times that look alike, as all slow warmings do, count once.
IncrementFit mean_over_times(const Record& record, double walk) {
    constexpr int n_times = 24;
    const double first_s = std::ranges::min(record.pieces, {}, &Piece::start_s).start_s;
    const double low = std::log(first_s + std::min(2.0 * record.segment_s, record.span_s / 20.0));
    const double high = std::log(record.span_s * 10.0);
    std::vector<IncrementFit> fits;
    std::vector<double> weights;
    for (int k = 0; k <= n_times; ++k) {
        const double tau_s = std::exp(low + (high - low) * k / n_times);
        fits.push_back(fit_known(record.angles, exponential_laws(record, tau_s), record.border_variance, walk));
        const Eigen::MatrixXd with_tau = exponential_laws_and_tau(record, tau_s, 1.0);
        const IncrementFit of_tau = fit_known(record.angles, with_tau, record.border_variance, walk);
        const double turn = fits.back().covariance(2, 2) / of_tau.covariance(3, 3);
        weights.push_back(turn > 0.0 ? tau_s * std::sqrt(turn) : 0.0);
    }
    // The weights of warmings that do not fit vanish.
    const double best = std::ranges::min_element(fits, {}, &IncrementFit::residual)->residual;
    double all = 0.0;
    for (std::size_t k = 0; k < fits.size(); ++k) all += weights[k] *= std::exp(-0.5 * (fits[k].residual - best));
    IncrementFit mean = fits.front();
    mean.residual = best;
    mean.coefficient.setZero();
    mean.covariance.setZero();
    for (std::size_t k = 0; k < fits.size(); ++k) mean.coefficient += weights[k] / all * fits[k].coefficient;
    for (std::size_t k = 0; k < fits.size(); ++k) {
        const Eigen::VectorXd apart = fits[k].coefficient - mean.coefficient;
        mean.covariance += weights[k] / all * (fits[k].covariance + apart * apart.transpose());
    }
    return mean;
}

// return  the walk, arcsec^2/s.
double find(const Record& record, DriftLaw& law) {
    const Exponential e = fit_exponential(record);
    const double walk = e.fit.walk_variance_per_s;
    if (e.determined) {
        take(record, e.fit, law);
        law.magnetic_thermal_arcsec_s = numeric::estimated(e.fit.coefficient[2], sigma(e.fit, 2));
        law.thermal_time_s = numeric::estimated(e.tau_s, sigma(e.fit, 3));
        return walk;
    }
    refuse_thermal(why_no_bend(record, fit_known(record.angles, straight_laws(record), record.border_variance, walk)),
                   law);
    IncrementFit fit = mean_over_times(record, walk);
    fit.walk_variance_sigma = e.fit.walk_variance_sigma;
    take(record, fit, law);
    return walk;
}

// By the midpoint rule, with 50 points or more a period of the fastest field.
double field_integral_g_s(const FieldCourse& field, const Piece& p) {
    const double samples = std::ceil(std::fmax(1000.0, 50.0 * fastest_field_hz * p.length_s));
    double sum_g = 0.0;
    for (double k = 0.5; k < samples; ++k) sum_g += field(p.start_s + p.length_s * k / samples);
    return sum_g * p.length_s / samples;
}

// too_few  why the temperatures tell no beta; empty: they may.
// return   the walk, arcsec^2/s.
double find_in_field(const Record& record, std::span<const FieldCourse> field, const std::string& too_few,
                     double reference_c, DriftLaw& law) {
    const Eigen::MatrixXd laws = record.laws(too_few.empty() ? 1 : 0, [&](const Piece& p, auto row) {
        row(0) = p.mode * field_integral_g_s(field[p.log], p);
        if (too_few.empty()) row(2) = row(0) * (p.temperature_c - reference_c);
    });
    const IncrementFit fit = fit_walk(record.angles, laws, record.border_variance);
    take(record, fit, law);
    const numeric::Estimate s = law.sensitivity_arcsec_s_g =
        laws.col(0).any() ? law.magnetic_arcsec_s : numeric::refused("the field is 0");
    if (!too_few.empty()) {
        law.sensitivity_per_c = numeric::refused(too_few);
    } else if (!(std::abs(s.value) > min_bend_sigmas * s.sigma)) {
        law.sensitivity_per_c = numeric::refused("the sensitivity itself is within its error of 0");
    } else {
        const double beta = fit.coefficient[2] / s.value;
        const Eigen::Vector3d by{-beta / s.value, 0.0, 1.0 / s.value};
        law.sensitivity_per_c = numeric::estimated(beta, std::sqrt(by.dot(fit.covariance * by)));
    }
    law.magnetic_arcsec_s = numeric::refused("the field is known: what follows the mode is the sensitivity to it");
    refuse_thermal(law.magnetic_arcsec_s.reason, law);
    return fit.walk_variance_per_s;
}

bool has_both_modes(const std::vector<Piece>& pieces) {
    const auto in_mode = [](int mode) { return [mode](const Piece& p) { return p.mode == mode; }; };
    return std::any_of(pieces.begin(), pieces.end(), in_mode(1)) &&
           std::any_of(pieces.begin(), pieces.end(), in_mode(-1));
}

RestCheck rest_of(std::span<const LabLog> logs, double scale_arcsec, double walk_arcsec2_s) {
    AngleScatter scatter;
    for (const LabLog& log : logs) scatter.add(log.scatter);
    return check_rest(scatter, walk_arcsec2_s * logs.front().tick_s / (scale_arcsec * scale_arcsec));
}

}  // namespace

DriftLaw find_drift_law(std::span<const LabLog> logs, double scale_arcsec, double rate_arcsec_s, const BiasLaw& bias,
                        std::span<const FieldCourse> field) {
    DriftLaw law;
    if (bias.contradicts) {
        refuse_all("counts, mode and bias_sign make no bias frequency together, so what follows the mode is not known",
                   law);
        law.rest.worst_ratio = std::numeric_limits<double>::quiet_NaN();
        return law;
    }
    const Record record{logs, scale_arcsec, rate_arcsec_s, bias};
    if (record.n() < min_pieces) {
        refuse_all(fmt::format("{} pieces of settled record; {} or more are needed", record.n(), min_pieces), law);
        return law;
    }
    if (!has_both_modes(record.pieces)) {
        refuse_all("one mode only: what follows the helicity cannot be separated from what does not", law);
        return law;
    }
    const double walk =
        field.empty() ? find(record, law)
                      : find_in_field(record, field, too_few_temperatures(logs), bias.reference_temperature_c, law);
    law.rest = rest_of(logs, scale_arcsec, walk);
    if (!law.rest.at_rest)
        refuse_all(fmt::format("the gyro was moved: over {} ticks the angle scatters with {:.3g} times the variance of "
                               "one at rest",
                               law.rest.worst_ticks, law.rest.worst_ratio),
                   law);
    return law;
}

}  // namespace zlg::calibration
