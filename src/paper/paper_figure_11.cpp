// Figure 11: noise of a replaced gap against its length.

#include <cmath>
#include <utility>

#include <zlg/design/substitution_noise.hpp>

#include "paper_bridge_curves.hpp"
#include "paper_words.hpp"

namespace zlg::paper {
namespace {

using namespace design;
using report::Figure;

constexpr double n_sigmas = 3.0;

design::Substitution substitution(Fit fit, int order, double n) {
    return {.fit = fit, .order = order, .n = static_cast<int>(std::lround(n))};
}

double tick_sigma_arcsec(const PaperTask& task) {
    return design::counter_tick_sigma_arcsec(task.config.gyro.scale_arcsec);
}

std::vector<double> lengths_of(const BridgePoints& points) {
    return each(points.of_noise, [](const SubstitutionPoint& p) { return p.n; });
}

// White and counter noise of the same size, and the twin.
void add_order(Figure& figure, const PaperTask& task, const BridgePoints& points, Fit fit, int order, int colour,
               const std::string& name) {
    const double unit = n_sigmas * tick_sigma_arcsec(task);
    const auto theory = [&](TickNoise noise) {
        return [&, noise](double n) { return unit * design::sum_gain(substitution(fit, order, n), noise); };
    };
    figure.series.push_back(
        curve({name + ", white noise", colour, true}, lengths_of(points), theory(TickNoise::white)));
    figure.series.push_back(curve({name + ", counter", colour}, lengths_of(points), theory(TickNoise::counter)));
    figure.series.push_back(twin_points({name + ", twin", colour}, lengths_of(points), points.of_noise, fit, order,
                                        [](const SubstitutionPoint& p) {
                                            return Measured{n_sigmas * p.rms.arcsec, n_sigmas * p.rms.error};
                                        }));
}

Figure corrected_figure(const PaperTask& task, const BridgePoints& points) {
    Figure figure = worded({.id = "figure-11", .log_y = true});
    for (const int order : sum_orders)
        add_order(figure, task, points, Fit::interpolation, order, order / 2, sum_order_name(order));
    figure.series.push_back(curve({"constant as printed, A\u221An/2", 2, true}, lengths_of(points), [&](double n) {
        return design::constant_noise_as_printed_arcsec(n_sigmas * tick_sigma_arcsec(task),
                                                        static_cast<int>(std::lround(n)));
    }));
    return figure;
}

Figure delivered_figure(const PaperTask& task, const BridgePoints& points) {
    Figure figure = worded({.id = "figure-11-delivered", .log_y = true});
    for (int order = 0; order < 3; ++order)
        add_order(figure, task, points, Fit::extrapolation, order, order, order_names[static_cast<std::size_t>(order)]);
    return figure;
}

double ratio(Fit fit, int order, double n, TickNoise noise) {
    return design::sum_gain(substitution(fit, order, n), noise) / design::sum_gain(substitution(fit, 0, n), noise);
}

report::Table ratio_table(const BridgePoints& points) {
    std::vector<std::vector<std::string>> rows;
    for (const SubstitutionResult& result : points.of_noise) {
        const int n = result.interpolation[0].n;
        rows.push_back({fmt::format("{}", n)});
        for (const auto& [fit, order] :
             {std::pair{Fit::interpolation, 2}, std::pair{Fit::extrapolation, 1}, std::pair{Fit::extrapolation, 2}})
            rows.back().push_back(
                filled("{:.2f} / {:.2f} / {:.2f}",
                       {ratio(fit, order, n, TickNoise::white), ratio(fit, order, n, TickNoise::counter),
                        point_of(result, fit, order).rms.arcsec / point_of(result, fit, 0).rms.arcsec}));
    }
    return table_of("figure 11.ratios", std::move(rows));
}

std::string range_of_ratio(const BridgePoints& points, Fit fit, int order) {
    const std::vector<double> x = lengths_of(points);
    return filled("{:.2f} to {:.2f}",
                  {ratio(fit, order, x.front(), TickNoise::white), ratio(fit, order, x.back(), TickNoise::white)});
}

// --- the twin's points of figures 8 to 11 against theory ------------------------------------------------------------

std::vector<SubstitutionPoint> of_motion(const BridgePoints& points, Fit fit, int order) {
    std::vector<SubstitutionPoint> all;
    const auto add = [&](const std::vector<SubstitutionResult>& results) {
        for (const SubstitutionResult& r : results) all.push_back(point_of(r, fit, order));
    };
    add(points.by_frequency);
    add(points.by_length);
    for (const auto& results : points.by_amplitude) add(results);
    return all;
}

struct Estimator {
    Fit fit;
    int order;
    const char* name;
};

constexpr Estimator estimators[] = {{Fit::interpolation, 0, "corrected, constant = linear"},
                                    {Fit::interpolation, 2, "corrected, quadratic"},
                                    {Fit::extrapolation, 0, "in real time, constant"},
                                    {Fit::extrapolation, 1, "in real time, linear"},
                                    {Fit::extrapolation, 2, "in real time, quadratic"}};

struct Agreement {
    ChiSquare motion;
    ChiSquare noise;
};

Agreement agreement(const BridgePoints& points, const Estimator& e) {
    std::vector<SubstitutionPoint> noise;
    for (const SubstitutionResult& r : points.of_noise) noise.push_back(point_of(r, e.fit, e.order));
    return {chi2_per_dof(of_motion(points, e.fit, e.order)), rms_chi2_per_dof(noise)};
}

report::Table agreement_table(const BridgePoints& points) {
    std::vector<std::vector<std::string>> rows;
    const auto cell = [](const ChiSquare& chi2) { return filled("{:.2f} ({})", {chi2.per_dof, chi2.dof}); };
    for (const Estimator& e : estimators) {
        const Agreement a = agreement(points, e);
        rows.push_back({e.name, cell(a.motion), cell(a.noise)});
    }
    return table_of("figure 11.agreement", std::move(rows));
}

}  // namespace

ChiSquare agreement_of_all(const BridgePoints& points) {
    ChiSquare all;
    double sum = 0.0;
    for (const Estimator& e : estimators) {
        const Agreement a = agreement(points, e);
        for (const ChiSquare& part : {a.motion, a.noise}) {
            sum += part.per_dof * part.dof;
            all.dof += part.dof;
        }
    }
    if (all.dof > 0) all.per_dof = sum / all.dof;
    return all;
}

PaperItem paper_figure_11(const PaperTask& task, const BridgePoints& points) {
    const double three_sigma = n_sigmas * tick_sigma_arcsec(task);
    const double lsb_arcsec = task.config.gyro.scale_arcsec;
    const auto gap_arcsec = [&](int order, TickNoise noise) {
        return three_sigma * design::sum_gain(substitution(Fit::interpolation, order, paper_gap_ticks), noise);
    };
    return item_of(
        "figure 11",
        {lsb_arcsec, tick_sigma_arcsec(task), three_sigma, 0.5 * lsb_arcsec,
         // does not:
         design::constant_noise_arcsec(three_sigma, paper_gap_ticks),
         design::constant_noise_as_printed_arcsec(three_sigma, paper_gap_ticks), gap_arcsec(0, TickNoise::white),
         gap_arcsec(0, TickNoise::counter), gap_arcsec(2, TickNoise::white), gap_arcsec(2, TickNoise::counter),
         // does not, either:
         range_of_ratio(points, Fit::interpolation, 2), points.of_noise.size(),
         range_of_ratio(points, Fit::extrapolation, 1), range_of_ratio(points, Fit::extrapolation, 2)},
        {ratio_table(points), agreement_table(points)},
        {corrected_figure(task, points), delivered_figure(task, points)});
}

}  // namespace zlg::paper
