#include "relock_borders.hpp"

#include <algorithm>
#include <array>

namespace zlg::calibration {
namespace {

// The sum of counts of the settled ticks of each segment.
std::vector<double> settled_counts(const LabLog& log) {
    std::vector<double> counts(log.segments.size(), 0.0);
    for (const Block& block : log.blocks)
        counts[static_cast<std::size_t>(block.segment)] += static_cast<double>(block.counts);
    return counts;
}

void collect(const LabLog& log, std::vector<RelockView>& views) {
    if (!log.has_square()) return;
    const std::vector<double> counts = settled_counts(log);
    for (const Relock& relock : log.relocks) {
        const auto index = static_cast<std::size_t>(relock.segment);
        const Segment& segment = log.segments[index];
        if (!is_whole(relock, &core::HalfRecord::detuning_sq_lambda2) || segment.n_settled < block_ticks) continue;
        views.push_back({&log, &relock, counts[index] / static_cast<double>(2 * segment.n_settled)});
    }
}

bool has_phase(const Relock& relock) {
    return relock.before.is_known() &&
           std::ranges::all_of(relock.halves, [](const core::HalfRecord& r) { return core::border_of(r).is_known(); });
}

double excess(const RelockView& view, std::size_t half) {
    return view.relock->halves[half].detuning_sq_lambda2 - view.log->square.mean;
}

}  // namespace

Relocks::Relocks(std::span<const LabLog> logs) {
    for (const LabLog& log : logs) collect(log, views);
    if (views.empty()) return;
    const bool with_phase = std::ranges::all_of(views, [](const RelockView& view) { return has_phase(*view.relock); });
    for (RelockView& view : views) view.with_phase = with_phase;
    std::vector<double> mean(relock_halves, 0.0);
    for (const RelockView& view : views)
        for (std::size_t h = 0; h < mean.size(); ++h) mean[h] += excess(view, h) / static_cast<double>(views.size());
    first_square_lambda2 = mean[0];
    const double least = 0.01 * *std::max_element(mean.begin(), mean.end());
    while (transient_halves < relock_halves / 2 && mean[transient_halves] > least) ++transient_halves;
    transient_halves = std::max<std::size_t>(transient_halves, 4);
}

bool Relocks::has_detunings() const {
    return std::ranges::all_of(views, [](const RelockView& view) {
        return std::ranges::all_of(view.relock->halves,
                                   [](const core::HalfRecord& r) { return std::abs(r.detuning_lambda) < 1e3; });
    });
}

namespace {

// Rows of the transient as they are; those of the rest as means over even and over odd borders.
RelockBorders averaged(const RelockBorders& all, Eigen::Index kept) {
    RelockBorders b{Eigen::VectorXd::Zero(kept + 2), Eigen::MatrixXd::Zero(kept + 2, all.x.cols())};
    b.y.head(kept) = all.y.head(kept);
    b.x.topRows(kept) = all.x.topRows(kept);
    std::array<double, 2> n{};
    for (Eigen::Index k = kept; k < all.y.size(); ++k) n[static_cast<std::size_t>(k % 2)] += 1.0;
    for (Eigen::Index k = kept; k < all.y.size(); ++k) {
        const double share = 1.0 / n[static_cast<std::size_t>(k % 2)];
        b.y[kept + k % 2] += share * all.y[k];
        b.x.row(kept + k % 2) += share * all.x.row(k);
    }
    return b;
}

// Of the re-locks of one kind.
struct Kind {
    Eigen::MatrixXd x;         // sum
    Eigen::VectorXd residual;  // sum
    double squares = 0.0;      // of the residuals
    double n = 0.0;

    void add(const RelockBorders& b, const Eigen::VectorXd& coefficient) {
        const Eigen::VectorXd left = b.y - b.x * coefficient;
        if (n == 0.0) {
            x = Eigen::MatrixXd::Zero(b.x.rows(), b.x.cols());
            residual = Eigen::VectorXd::Zero(left.size());
        }
        x += b.x;
        residual += left;
        squares += left.squaredNorm();
        n += 1.0;
    }
    // About the mean of its row.
    [[nodiscard]] double scatter() const { return n > 0.0 ? squares - residual.squaredNorm() / n : 0.0; }
};

void take_repeated(const std::vector<RelockBorders>& all, LossFit& fit) {
    std::array<Kind, 4> kinds;
    for (const RelockBorders& b : all) kinds[static_cast<std::size_t>(b.kind)].add(b, fit.coefficient);
    Eigen::MatrixXd shared = Eigen::MatrixXd::Zero(fit.coefficient.size(), fit.coefficient.size());
    double scatter = 0.0;
    double dof = 0.0;
    for (const Kind& kind : kinds) {
        if (kind.n == 0.0) continue;
        shared += kind.x.transpose() * kind.x;
        scatter += kind.scatter();
        dof += (kind.n - 1.0) * static_cast<double>(kind.x.rows() - 1);
    }
    const double scattered = dof > 0.0 ? scatter / dof : 0.0;
    fit.repeated_ratio = std::max(0.0, 1.0 - scattered / fit.rounding);
    fit.repeated_covariance = fit.repeated_ratio * fit.rounding * (fit.inverse * shared * fit.inverse);
}

}  // namespace

LossFit fit_losses(const std::vector<RelockBorders>& all, numeric::Laws laws) {
    std::vector<numeric::Cluster> clusters;
    for (const RelockBorders& b : all) {
        clusters.push_back({b.x.transpose() * b.x, b.x.transpose() * b.y});
        clusters.back().information.topLeftCorner(b.noise.rows(), b.noise.cols()) -= b.noise;
    }
    LossFit fit{fit_clusters(clusters, laws)};
    fit.rounding = all.front().rounding;
    double expected = -fit.rounding * static_cast<double>(fit.coefficient.size());
    for (const RelockBorders& b : all) {
        fit.residual += (b.y - b.x * fit.coefficient).squaredNorm();
        const auto c = fit.coefficient.head(b.noise.rows());
        expected += fit.rounding * static_cast<double>(b.y.size() - 1) + c.dot(b.noise * c);
    }
    fit.chi2_per_dof = fit.residual / expected;
    take_repeated(all, fit);
    return fit;
}

Eigen::Index halves_used(const RelockView& view, std::size_t transient) {
    return static_cast<Eigen::Index>(std::min(view.relock->halves.size(), 2 * transient + 4));
}

RelockBorders relock_borders(const RelockView& view, const BiasLaw& law, std::size_t transient, Eigen::Index n_laws,
                             const LossLaws& losses) {
    const std::vector<core::HalfRecord>& halves = view.relock->halves;
    const Eigen::Index n = halves_used(view, transient);
    RelockBorders all{Eigen::VectorXd::Zero(n + 1), Eigen::MatrixXd::Zero(n + 1, n_laws + 1)};
    Eigen::RowVectorXd loss = Eigen::RowVectorXd::Zero(n_laws);
    const auto place = [&view](const core::Border& border) {
        return view.with_phase ? core::counts_and_parts(0, border.parts()) : 0.0;
    };
    double counted = 0.0;
    all.y[0] = place(view.relock->before);
    const double first_sign = halves[0].bias_sign * halves[0].mode;
    for (Eigen::Index h = 0; h < n; ++h) {
        const core::HalfRecord& r = halves[static_cast<std::size_t>(h)];
        const double cycles = 0.5 * view.log->tick_s * law.at_hz(r.temperature_c) * r.bias_sign * r.mode;
        losses(r, loss);
        counted = counted + static_cast<double>(r.counts) - cycles - view.counts_per_half;
        all.y[h + 1] = counted + place(core::border_of(r));
        all.x.row(h + 1).head(n_laws) = all.x.row(h).head(n_laws) - cycles * loss;
        all.x(h + 1, n_laws) = h % 2 == 0 ? first_sign : 0.0;
    }
    RelockBorders b = averaged(all, static_cast<Eigen::Index>(transient + 1));
    if (view.with_phase) b.rounding = place_counts2;
    b.kind = (first_sign > 0.0 ? 1 : 0) + (halves[0].mode > 0 ? 2 : 0);
    b.y.array() -= b.y.mean();
    b.x.rowwise() -= b.x.colwise().mean().eval();
    return b;
}

}  // namespace zlg::calibration
