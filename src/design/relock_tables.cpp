#include <zlg/design/relock_tables.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/math/tools/minima.hpp>

#include "range_check.hpp"

namespace zlg::design {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// Of the decays, in the order of the enumerators.
constexpr std::array<std::string_view, 4> names{"exponential", "constant slew", "slew with exponential tail",
                                                "critically damped second order"};

void check(const RelockModel& m) {
    require_not_negative("re-lock model", "deficit_arcsec_s", m.deficit_arcsec_s);
    require_positive("re-lock model", "time_s", m.time_s);
    if (m.decay == Decay::slew_tail) require_positive("re-lock model", "tail_s", m.tail_s);
}

// Integrals of d and d^2 from 0 to t.
using Integrals = HalfMeans;

Integrals exponential(double t, double tau) {
    return {-tau * std::expm1(-t / tau), -0.5 * tau * std::expm1(-2.0 * t / tau)};
}

Integrals slew(double t, double time) {
    const double left = std::max(0.0, 1.0 - t / time);
    return {0.5 * time * (1.0 - left * left), time / 3.0 * (1.0 - left * left * left)};
}

Integrals slew_tail(double t, double time, double tail) {
    const double at_change = std::min(1.0, tail / time);  // d where d/tail = 1/time
    const double change = time * (1.0 - at_change);
    if (t <= change) return slew(t, time);
    const Integrals before = slew(change, time);
    const Integrals after = exponential(t - change, tail);
    return {before.d + at_change * after.d, before.d_square + at_change * at_change * after.d_square};
}

Integrals critical(double t, double time) {
    const double u = t / time;
    const double e = std::exp(-u);
    return {time * (2.0 - (2.0 + u) * e), time * (1.25 - (0.5 * u * u + 1.5 * u + 1.25) * e * e)};
}

Integrals integrals(const RelockModel& m, double t) {
    switch (m.decay) {
        case Decay::slew: return slew(t, m.time_s);
        case Decay::slew_tail: return slew_tail(t, m.time_s, m.tail_s);
        case Decay::critical: return critical(t, m.time_s);
        case Decay::exponential: break;
    }
    return exponential(t, m.time_s);
}

double rms_difference(const TickDrifts& a, const TickDrifts& b) {
    double square = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(square / table_ticks);
}

// The drifts are linear in the deficit, so for given times it follows in closed form and only the times are searched
// (variable projection).
RelockFit with_best_deficit(RelockModel model, const TickDrifts& measured) {
    model.deficit_arcsec_s = 1.0;
    const TickDrifts unit = drift_arcsec_s(model);
    double product = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < unit.size(); ++i) {
        product += unit[i] * measured[i];
        square += unit[i] * unit[i];
    }
    model.deficit_arcsec_s = square > 0.0 ? std::max(0.0, product / square) : 0.0;
    RelockFit fit{names.at(static_cast<std::size_t>(model.decay)), model, drift_arcsec_s(model)};
    fit.rms_arcsec_s = rms_difference(fit.drift_arcsec_s, measured);
    return fit;
}

// Minimum over log time within T/20..50 T, far below and above what four ticks can show: the best of a grid, then
// Brent's method between its neighbours. f(log time) -> RelockFit.
template <class F> RelockFit minimise(F f, int n_grid) {
    const double low = std::log(table_tick_s / 20.0);
    const double step = (std::log(50.0 * table_tick_s) - low) / n_grid;
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= n_grid; ++k) {
        const double rms = f(low + k * step).rms_arcsec_s;
        if (rms < least) {
            least = rms;
            best = k;
        }
    }
    const auto rms = [&](double x) { return f(x).rms_arcsec_s; };
    const double middle = low + best * step;
    return f(boost::math::tools::brent_find_minima(rms, middle - step, middle + step, 40).first);
}

double detuning_formula(double deficit, double first, double second) {
    const double rho = second / first;
    if (!(rho > 0.0 && rho < 1.0)) return unknown;
    return -0.25 * deficit * std::log(rho) * (first + second) * (first + second);
}

}  // namespace

TableSummary summarise(const TickDrifts& measured, const TickDrifts& computed) {
    TableSummary s;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        s.residual_arcsec_s[i] = measured[i] - computed[i];
        s.mean_arcsec_s += s.residual_arcsec_s[i] / table_ticks;
    }
    s.angle_arcsec = s.mean_arcsec_s * table_ticks * table_tick_s;
    s.angle_without_first_arcsec = s.angle_arcsec - s.residual_arcsec_s[0] * table_tick_s;
    s.rms_arcsec_s = rms_difference(measured, computed);
    return s;
}

std::array<double, table_ticks - 1> local_time_constants_s(const TickDrifts& drift) {
    std::array<double, table_ticks - 1> tau{};
    for (std::size_t i = 0; i < tau.size(); ++i) tau[i] = 2.0 * table_tick_s / std::log(drift[i] / drift[i + 1]);
    return tau;
}

HalfMeans half_means(const RelockModel& model, int half, double tick_s) {
    check(model);
    require(half >= 0, "re-lock model", "half", half, "0 or more");
    require_positive("re-lock model", "tick_s", tick_s);
    const double length = 0.5 * tick_s;
    const Integrals a = integrals(model, half * length);
    const Integrals b = integrals(model, (half + 1) * length);
    return {(b.d - a.d) / length, (b.d_square - a.d_square) / length};
}

TickDrifts drift_arcsec_s(const RelockModel& model) {
    TickDrifts drift{};
    for (int i = 0; i < table_ticks; ++i) {
        drift[static_cast<std::size_t>(i)] =
            0.5 * model.deficit_arcsec_s * (half_means(model, 2 * i).d_square - half_means(model, 2 * i + 1).d_square);
    }
    return drift;
}

TickDrifts deficit_arcsec_s(const RelockModel& model) {
    TickDrifts deficit{};
    for (int i = 0; i < table_ticks; ++i) {
        deficit[static_cast<std::size_t>(i)] =
            0.5 * model.deficit_arcsec_s * (half_means(model, 2 * i).d_square + half_means(model, 2 * i + 1).d_square);
    }
    return deficit;
}

RelockFit fit_relock(Decay decay, const TickDrifts& measured) {
    for (const double drift : measured) require_finite("fit of a re-lock model", "measured drift", drift);
    if (decay != Decay::slew_tail) {
        return minimise([&](double x) { return with_best_deficit({decay, 0.0, std::exp(x), 0.0}, measured); }, 200);
    }
    const auto best_tail = [&](double x) {
        return minimise(
            [&](double y) {
                return with_best_deficit({decay, 0.0, std::exp(x), std::exp(y)}, measured);
            },
            60);
    };
    return minimise(best_tail, 60);
}

TickDrifts corrected_by_frequency_arcsec_s(const RelockModel& model) {
    const TickDrifts deficit = deficit_arcsec_s(model);
    TickDrifts drift{};
    for (std::size_t i = 0; i < drift.size(); ++i) {
        const std::size_t from = i == 0 ? 1 : i;
        const double q = std::pow(deficit[from] / deficit[0], 0.5 / static_cast<double>(from));
        drift[i] = q > 0.0 && q < 1.0 ? deficit[i] * (1.0 - q) / (1.0 + q) : unknown;
    }
    return drift;
}

TickDrifts corrected_by_detuning_arcsec_s(const RelockModel& model) {
    TickDrifts drift{};
    for (int i = 0; i < table_ticks; ++i) {
        const double first = half_means(model, 2 * i).d;
        const double second = half_means(model, 2 * i + 1).d;
        drift[static_cast<std::size_t>(i)] = detuning_formula(model.deficit_arcsec_s, first, second);
    }
    return drift;
}

}  // namespace zlg::design
