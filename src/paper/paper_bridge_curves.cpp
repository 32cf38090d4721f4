#include "paper_bridge_curves.hpp"

#include <fmt/format.h>

#include <zlg/design/taylor.hpp>

namespace zlg::paper {
namespace {

using design::Fit;
using report::Series;

const char* order_name(int order) { return order_names[static_cast<std::size_t>(order)]; }

// The component of the axis' own region.
Series region_points(Look look, const Axis& axis, Fit fit, int order) {
    return twin_points(std::move(look), axis.measured, axis.results, fit, order,
                       [&](const SubstitutionPoint& p) { return measured(p, axis.region); });
}

}  // namespace

Series twin_points(Look look, const std::vector<double>& x, const std::vector<SubstitutionResult>& results, Fit fit,
                   int order, const std::function<Measured(const SubstitutionPoint&)>& of) {
    Series s{.name = std::move(look.name), .x = x, .mark = report::Mark::points, .colour = look.colour};
    for (const SubstitutionResult& result : results) {
        const Measured m = of(point_of(result, fit, order));
        s.y.push_back(m.arcsec);
        s.y_error.push_back(m.error);
    }
    return s;
}

std::vector<double> each(const std::vector<SubstitutionResult>& results,
                         const std::function<double(const SubstitutionPoint&)>& of) {
    std::vector<double> all;
    for (const SubstitutionResult& r : results) all.push_back(of(r.interpolation[0]));
    return all;
}

void add_exact(const Axis& axis, SeriesList& all) {
    for (const int order : sum_orders)
        all.push_back(curve({sum_order_name(order), order / 2}, axis.shown,
                            [&](double x) { return exact_error_arcsec(axis.case_at(x), Fit::interpolation, order); }));
}

void add_leading_laws(const Axis& axis, SeriesList& all) {
    for (const int order : sum_orders)
        all.push_back(
            curve({fmt::format("leading law, {}", sum_order_name(order)), order / 2, true}, axis.shown, [&](double x) {
                const BridgeCase c = axis.case_at(x);
                const design::Tone tone{.amplitude_arcsec_s = c.amplitude_arcsec_s, .frequency_hz = c.frequency_hz};
                return -design::leading_error_arcsec(tone, order, c.n, c.tick_s);
            }));
}

void add_twin(const Axis& axis, int first_colour, SeriesList& all) {
    for (const int order : sum_orders)
        all.push_back(region_points({fmt::format("twin, {}", sum_order_name(order)), first_colour + order / 2}, axis,
                                    Fit::interpolation, order));
}

SeriesList corrected(const Axis& axis) {
    SeriesList all;
    const auto series = [&](int order) {
        return [&, order](double x) { return series_error_arcsec(axis.case_at(x), order); };
    };
    if (axis.region == Region::crossing) {
        all.push_back(curve({theory_of_crossing, 0}, axis.shown, [](double) { return 0.0; }));
        all.push_back(curve({"series as printed, cubic term 1", 1, true}, axis.shown,
                            [&](double x) { return series_error_as_printed_arcsec(axis.case_at(x), 2); }));
        all.push_back(curve({"series, cubic term 4/3", 2, true}, axis.shown, series(2)));
        add_twin(axis, 3, all);
    } else {
        add_exact(axis, all);
        all.push_back(curve({"series, linear", 0, true}, axis.shown, series(0)));
        all.push_back(curve({"series, quadratic", 1, true}, axis.shown, series(2)));
        add_twin(axis, 0, all);
    }
    return all;
}

SeriesList delivered(const Axis& axis) {
    SeriesList all;
    for (int order = 0; order < 3; ++order)
        all.push_back(curve({order_name(order), order}, axis.shown,
                            [&](double x) { return exact_error_arcsec(axis.case_at(x), Fit::extrapolation, order); }));
    for (int order = 0; order < 3; ++order)
        all.push_back(
            region_points({fmt::format("twin, {}", order_name(order)), order}, axis, Fit::extrapolation, order));
    return all;
}

}  // namespace zlg::paper
