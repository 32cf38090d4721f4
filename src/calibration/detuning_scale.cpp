#include <zlg/calibration/detuning_scale.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <zlg/numeric/cluster_fit.hpp>

#include "relock_borders.hpp"

namespace zlg::calibration {
namespace {

constexpr std::int64_t min_relocks_of_scale = 4;

// Of the mean over a half by the cubic: (1 + 169 + 169 + 1)/576 of the variance of a reading.
constexpr double cubic_noise = 340.0 / 576.0;
// Of what the cubic corrects the straight line by, this part may be missing from the true transient.
constexpr double cubic_uncertainty = 0.1;
// Beyond this part of the scale even the cubic does not follow the transient: an exponential that falls to 0.6 in a
// half is corrected by 2 %, and by 1 part in 1000 wrongly.
constexpr double max_correction = 0.025;

// A digital loop that brings the mean square of the detuning down to less than this from one half to the next goes by
// steps that the readings at their ends do not resolve.
constexpr double min_stepped_fall = 0.13;

// Logged mean detunings of one re-lock against columns of travel, as sums of products; less what the noise of the
// readings adds.
struct Travel : numeric::Cluster {
    double squares = 0.0;  // of the detunings
    std::int64_t n = 0;

    explicit Travel(Eigen::Index columns)
        : Cluster{Eigen::MatrixXd::Zero(columns, columns), Eigen::VectorXd::Zero(columns)} {}

    void add(const Eigen::VectorXd& x, const Eigen::VectorXd& noise, double y) {
        information += x * x.transpose();
        information.diagonal() -= noise;
        products += x * y;
        squares += y * y;
        ++n;
    }
    [[nodiscard]] bool is_finite() const { return n > 0 && information.allFinite() && products.allFinite(); }
};

// Voltages above that of rest, which goes on drifting as it does in the settled segment.
struct Readings {
    const std::vector<core::HalfRecord>& halves;
    const Segment& segment;
    double slope_v;  // a half
    double variance_v2;

    explicit Readings(const RelockView& view)
        : halves{view.relock->halves},
          segment{view.log->segments[static_cast<std::size_t>(view.relock->segment)]},
          slope_v{0.5 * slope_v_per_tick(segment)},
          variance_v2{view.log->piezo_variance_v2} {}

    [[nodiscard]] double v(std::size_t h) const {
        const double later = static_cast<double>(halves[h].half + 1) - 2.0 * segment.at_start.middle_ticks;
        return halves[h].piezo_v - segment.at_start.voltage_v - slope_v * later;
    }
};

// Against one column of mean voltage per half, whose variance is `noise` times that of a reading. The first half begins
// before the loop is closed, so the first cubic begins with its end.
template <class Mean>
Travel smooth_cluster(const RelockView& view, const HalfWaveLaw& law, std::size_t transient, double noise, Mean mean) {
    const Readings r{view};
    Travel c{1};
    for (std::size_t h = 2; h < transient && h + 1 < r.halves.size(); ++h) {
        const double lambda_per_v = 0.5 / law.at_v(r.halves[h].temperature_c);
        c.add(Eigen::VectorXd::Constant(1, lambda_per_v * mean(r, h)),
              Eigen::VectorXd::Constant(1, noise * r.variance_v2 * lambda_per_v * lambda_per_v),
              r.halves[h].detuning_lambda);
    }
    return c;
}

Travel cubic_cluster(const RelockView& view, const HalfWaveLaw& law, std::size_t transient) {
    return smooth_cluster(view, law, transient, cubic_noise, [](const Readings& r, std::size_t h) {
        return (13.0 * (r.v(h - 1) + r.v(h)) - r.v(h - 2) - r.v(h + 1)) / 24.0;
    });
}

Travel straight_cluster(const RelockView& view, const HalfWaveLaw& law, std::size_t transient) {
    return smooth_cluster(view, law, transient, 0.5,
                          [](const Readings& r, std::size_t h) { return 0.5 * (r.v(h - 1) + r.v(h)); });
}

// A voltage that is commanded half by half: it goes from the one reading to the next in a way that is always the same,
// so its mean lies anywhere between them, the second unknown.
Travel stepped_cluster(const RelockView& view, const HalfWaveLaw& law, std::size_t transient) {
    const Readings r{view};
    Travel c{2};
    for (std::size_t h = 1; h < transient; ++h) {
        const double lambda_per_v = 0.5 / law.at_v(r.halves[h].temperature_c);
        const double noise = r.variance_v2 * lambda_per_v * lambda_per_v;
        c.add(lambda_per_v * Eigen::Vector2d(0.5 * (r.v(h - 1) + r.v(h)), r.v(h) - r.v(h - 1)),
              noise * Eigen::Vector2d(0.5, 2.0), r.halves[h].detuning_lambda);
    }
    return c;
}

struct Fit {
    double scale = 0.0;
    double sigma = 0.0;
    double rms_lambda = 0.0;
    std::int64_t n_relocks = 0;
};

template <class MakeCluster>
Fit fit(const Relocks& relocks, const HalfWaveLaw& law, MakeCluster make) {
    std::vector<numeric::Cluster> clusters;
    double squares = 0.0;
    double n = 0.0;
    for (const RelockView& view : relocks.views) {
        const Travel c = make(view, law, relocks.transient_halves);
        if (!c.is_finite()) continue;
        clusters.push_back(c);
        squares += c.squares;
        n += static_cast<double>(c.n);
    }
    Fit result{.n_relocks = std::ssize(clusters)};
    if (result.n_relocks < min_relocks_of_scale) return result;
    const numeric::ClusterFit found = numeric::fit_clusters(clusters);
    const auto dof = static_cast<double>(result.n_relocks - found.coefficient.size());
    for (const numeric::Cluster& c : clusters) squares -= found.coefficient.dot(c.products);
    result.scale = found.coefficient[0];
    result.sigma = numeric::widened(std::sqrt(found.covariance(0, 0)), dof);
    result.rms_lambda = std::sqrt(std::max(0.0, squares) / n);
    return result;
}

}  // namespace

DetuningScale find_detuning_scale(std::span<const LabLog> logs, const HalfWaveLaw& law, bool stepped_voltage) {
    DetuningScale result;
    if (!law.half_wave_v.determined) {
        result.scale = numeric::refused("the half-wave voltage is not determined");
        return result;
    }
    const Relocks relocks{logs};
    const Fit f = stepped_voltage ? fit(relocks, law, stepped_cluster) : fit(relocks, law, cubic_cluster);
    result.n_relocks = f.n_relocks;
    if (result.n_relocks < min_relocks_of_scale) {
        result.scale = numeric::refused(
            fmt::format("{} re-locks with the columns detuning_lambda and piezo_v; {} or more are needed",
                        result.n_relocks, min_relocks_of_scale));
        return result;
    }
    if (stepped_voltage && relocks.steepest_fall < min_stepped_fall) {
        result.scale = numeric::refused(
            fmt::format("the mean square of the detuning falls to {:.2g} of it from one half to the next, allowed is "
                        "{:g} for a digital loop: its course within a half is not seen; a slower loop would tell",
                        relocks.steepest_fall, min_stepped_fall));
        return result;
    }
    const double of_ruler = f.scale * law.half_wave_v.sigma / law.half_wave_v.value;
    const double corrected = stepped_voltage ? 0.0 : f.scale - fit(relocks, law, straight_cluster).scale;
    if (std::abs(corrected) > max_correction * std::abs(f.scale)) {
        result.scale = numeric::refused(fmt::format(
            "the re-lock is over within {} halves: its course within one is not seen (the cubic corrects by {:.2g} %, "
            "allowed is {:g} %); a shorter tick would tell",
            relocks.transient_halves, 100.0 * std::abs(corrected / f.scale), 100.0 * max_correction));
        return result;
    }
    const double of_course = cubic_uncertainty * corrected;
    const double sigma = std::hypot(f.sigma, of_ruler, of_course);
    result.scatter_lambda = f.rms_lambda;
    result.scale = sigma < 0.3 * std::abs(f.scale)
                       ? numeric::estimated(f.scale, sigma)
                       : numeric::refused(
                             fmt::format("{:.2g} +- {:.2g} from {} re-locks; more switches or a larger miss would tell",
                                         f.scale, sigma, f.n_relocks));
    return result;
}

}  // namespace zlg::calibration
