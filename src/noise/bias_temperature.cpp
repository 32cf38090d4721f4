#include <zlg/noise/bias_temperature.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Dense>

#include <zlg/deviations/series.hpp>

#include "walked_fit.hpp"

namespace zlg::noise {
namespace {

constexpr std::size_t max_stretches = 128, min_stretches = 16;
constexpr Eigen::Index max_order = 3, of_input = max_order + 1, way = 2 * of_input, n_laws = way + 1;
constexpr double sigmas = 3.0;  // of a coefficient that is one

// A stretch: means of the rate, of x^k, and of input x^k; x in parts of the span.
using Means = Eigen::Matrix<double, 1 + way, 1>;

struct Stretches {
    Eigen::VectorXd rate;
    Eigen::MatrixXd laws;  // of each column x^0 .. x^3, input x^0 .. x^3, d
};

void check(const TemperatureRecord& r) {
    const std::size_t n = r.rates_arcsec_s.size();
    const bool is_good = r.temperature_c.size() == n && (r.input_arcsec_s.empty() || r.input_arcsec_s.size() == n);
    if (!is_good)
        throw deviations::SeriesError(
            fmt::format("temperature: {} rates, {} temperatures and {} rates of a table, allowed are as many of each",
                        n, r.temperature_c.size(), r.input_arcsec_s.size()));
}

void take_range(const TemperatureRecord& r, BiasTemperature& found) {
    found.least_c = std::numeric_limits<double>::infinity();
    found.most_c = -found.least_c;
    double known = 0.0;
    for (std::size_t k = 0; k < r.temperature_c.size(); ++k) {
        const double t = r.temperature_c[k];
        if (!std::isfinite(t) || !std::isfinite(r.rates_arcsec_s[k])) continue;
        known += 1.0;
        found.mean_c += (t - found.mean_c) / known;
        found.least_c = std::min(found.least_c, t);
        found.most_c = std::max(found.most_c, t);
    }
    if (!(found.most_c > found.least_c))
        throw deviations::SeriesError("temperature: it does not change, so nothing follows it");
}

Stretches stretches_of(const TemperatureRecord& r, double mean_c, double span) {
    const std::size_t n = r.rates_arcsec_s.size(),
                      length = std::max<std::size_t>(1, (n + max_stretches - 1) / max_stretches);
    std::vector<Means> all;
    for (std::size_t from = 0; from + length <= n; from += length) {
        Means mean = Means::Zero(), row;
        double known = 0.0;
        for (std::size_t k = from; k < from + length; ++k) {
            row[0] = r.rates_arcsec_s[k];
            double power = 1.0;
            for (Eigen::Index p = 1; p <= of_input; ++p, power *= (r.temperature_c[k] - mean_c) / span) {
                row[p] = power;
                row[of_input + p] = r.input_arcsec_s.empty() ? 0.0 : r.input_arcsec_s[k] * power;
            }
            if (row.allFinite()) known += 1.0, mean += (row - mean) / known;
        }
        if (2.0 * known >= static_cast<double>(length)) all.push_back(mean);
    }
    if (all.size() < min_stretches)
        throw deviations::SeriesError(
            fmt::format("temperature: {} stretches of rate and temperature are known, {} or more are needed",
                        all.size(), min_stretches));
    const Eigen::Index rows = std::ssize(all);
    Stretches s{.rate = Eigen::VectorXd(rows), .laws = Eigen::MatrixXd(rows, n_laws)};
    for (Eigen::Index k = 0; k < rows; ++k) {
        s.rate[k] = all[static_cast<std::size_t>(k)][0];
        s.laws.row(k).head(way) = all[static_cast<std::size_t>(k)].tail(way).transpose();
    }
    for (Eigen::Index k = 0; k < rows; ++k) {
        const double rise = s.laws(std::min(k + 1, rows - 1), 1) - s.laws(std::max<Eigen::Index>(k - 1, 0), 1);
        s.laws(k, way) = rise > 0.0 ? 1.0 : rise < 0.0 ? -1.0 : 0.0;
    }
    // Without both ways of going there is no difference between them.
    auto d = s.laws.col(way);
    if (!((d.array() > 0.0).any() && (d.array() < 0.0).any())) d.setZero();
    return s;
}

struct Fit {
    Eigen::VectorXd value = Eigen::VectorXd::Zero(n_laws), sigma = value;  // 0: not fitted
    double dof = 0.0;

    [[nodiscard]] bool shows(Eigen::Index k) const { return std::abs(value[k]) > sigmas * sigma[k] && sigma[k] > 0.0; }
};

// The mean over white noise and walks.
Fit fit_of(const Stretches& s, Eigen::Index order) {
    std::vector<Eigen::Index> columns;
    for (Eigen::Index k = 0; k < n_laws; ++k)
        if ((k == way || k % of_input <= order) && (s.laws.col(k).array() != 0.0).any()) columns.push_back(k);
    const std::vector<WalkedFit> fits = walked_fits(s.laws(Eigen::all, columns), s.rate);
    Fit fit;
    fit.dof = static_cast<double>(s.rate.size() - std::ssize(columns));
    if (fits.empty()) fit.sigma.setConstant(std::numeric_limits<double>::quiet_NaN());
    for (const WalkedFit& each : fits) fit.value(columns) += each.weight * each.value;
    for (const WalkedFit& each : fits)
        fit.sigma(columns) += each.weight * (each.variance + (each.value - fit.value(columns)).cwiseAbs2());
    fit.sigma = fit.sigma.cwiseSqrt();
    return fit;
}

}  // namespace

double BiasTemperature::drift_arcsec_s(double temperature_c) const {
    double drift = 0.0;
    const double x = temperature_c - mean_c;
    for (int k = order; k > 0; --k) drift = (drift + bias[static_cast<std::size_t>(k)].value) * x;
    return drift;
}

BiasTemperature bias_temperature(const TemperatureRecord& record) {
    check(record);
    BiasTemperature found;
    take_range(record, found);
    const double span = (found.most_c - found.least_c) / 2.0;
    const Stretches s = stretches_of(record, found.mean_c, span);
    Fit fit;
    Eigen::Index order = max_order;
    for (; order > 0; --order) {
        fit = fit_of(s, order);
        if (fit.shows(order) || fit.shows(of_input + order)) break;
    }
    found.order = static_cast<int>(order);
    const auto coefficient = [&](Eigen::Index k, Eigen::Index power) {
        const double unit = std::pow(span, static_cast<double>(power));
        return numeric::estimated(fit.value[k] / unit, numeric::widened(fit.sigma[k] / unit, fit.dof));
    };
    for (Eigen::Index k = 0; k <= std::max<Eigen::Index>(order, 1); ++k) {
        found.bias.push_back(coefficient(k, k));
        if (!record.input_arcsec_s.empty()) found.scale.push_back(coefficient(of_input + k, k));
    }
    found.hysteresis_arcsec_s =
        fit.sigma[way] > 0.0 ? numeric::estimated(2.0 * fit.value[way], 2.0 * numeric::widened(fit.sigma[way], fit.dof))
                             : numeric::refused("the temperature only rises, or only falls");
    return found;
}

}  // namespace zlg::noise
