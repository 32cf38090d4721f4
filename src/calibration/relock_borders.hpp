#pragma once
// The re-locks of all logs that can be compared with each other, and how long their transient lasts.

#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <zlg/calibration/bias_law.hpp>
#include <zlg/calibration/lab_log.hpp>
#include <zlg/numeric/cluster_fit.hpp>

namespace zlg::calibration {

struct RelockView {
    const LabLog* log;
    const Relock* relock;
    double counts_per_half = 0.0;  // of the settled rest of the segment: rotation and drift
    bool with_phase = false;       // of this re-lock, as of all: the places within the count are known
};

inline double square(double x) { return x * x; }

// A half as two equal groups of samples.
struct Groups {
    double above;
    double below;

    Groups(const core::HalfRecord& r, double noise_lambda2) {
        const double spread2 = r.detuning_sq_lambda2 - square(r.detuning_lambda) - noise_lambda2;
        const double spread = std::sqrt(std::fmax(spread2, 0.0));
        above = r.detuning_lambda + spread;
        below = r.detuning_lambda - spread;
    }
    [[nodiscard]] double farthest() const { return std::fmax(std::abs(above), std::abs(below)); }
};

struct Relocks {
    std::vector<RelockView> views;
    std::size_t transient_halves = 0;   // until the mean excess of the mean square is below 1 % of its highest
    double first_square_lambda2 = 0.0;  // mean excess in the first half

    // Re-locks with mean squares in every half, and a settled rest that is four times as long as the transient kept.
    explicit Relocks(std::span<const LabLog> logs);

    [[nodiscard]] bool has_detunings() const;
};

inline constexpr double rounding_counts2 = 1.0 / 12.0;  // of one border
// By phase: what the settled counts leave of the rotation over a re-lock, and the random walk, of a gyro at rest.
inline constexpr double place_counts2 = 1e-5;

// The counts after a re-lock at the borders of its halves, against what each law would make of them.
//
//   y_k = sum of the counts before border k, less rotation and an undisturbed bias
//   x_k = the same sum of -s_h f (T/2) g_h, for the loss g_h that a law gives per unit of its coefficient
//
// With the places within the count, where all re-locks have them. The counter rounds at each border once, so that the
// rows are of independent errors. Borders after the transient make one row for each of the two readings that a settled
// counter repeats. The last column is the parity of the border: an error of f shows there.
struct RelockBorders {
    Eigen::VectorXd y;
    Eigen::MatrixXd x;
    double rounding = rounding_counts2;  // variance of one border
    int kind = 0;                        // of the re-lock: helicity and first sign of the bias
    Eigen::MatrixXd noise = {};          // what light noise adds to the products of the laws' columns; empty: nothing
};

// As long again as the transient for the rest: every half of it brings light noise.
[[nodiscard]] Eigen::Index halves_used(const RelockView& view, std::size_t transient);

// The loss of one half by each law, per unit of its coefficient.
using LossLaws = std::function<void(const core::HalfRecord&, Eigen::Ref<Eigen::RowVectorXd>)>;

// Each column less its mean: the rounding at the first border is common to all.
[[nodiscard]] RelockBorders relock_borders(const RelockView& view, const BiasLaw& law, std::size_t transient,
                                           Eigen::Index n_laws, const LossLaws& losses);

// The loss of bias by these laws, and the parity, from the borders of all re-locks. Rounding that does not scatter from
// one re-lock of a kind to the next is an unknown that all of them share.
struct LossFit : numeric::ClusterFit {
    double rounding = 0.0;                // variance of one border
    double residual = 0.0;                // sum of squares
    double chi2_per_dof = 0.0;            // over rounding and light noise
    double repeated_ratio = 0.0;          // part of the variance of rounding that is the same after every re-lock
    Eigen::MatrixXd repeated_covariance;  // what that adds
};

[[nodiscard]] LossFit fit_losses(const std::vector<RelockBorders>& all, numeric::Laws laws);

}  // namespace zlg::calibration
