#include "paper_bridge_curves.hpp"

namespace zlg::paper {
namespace {

using design::Fit;
using report::Series;

double zero(const BridgeCase&, int) { return 0.0; }
double exact(const BridgeCase& c, int order) { return exact_error_arcsec(c, Fit::interpolation, order); }
double live(const BridgeCase& c, int order) { return exact_error_arcsec(c, Fit::extrapolation, order); }

constexpr Row at_crossing[] = {{"theory, any order: 0", 0, 0, false, zero},
                               {"series as printed, cubic term 1", 2, 1, true, series_error_as_printed_arcsec},
                               {"series, cubic term 4/3", 2, 2, true, series_error_arcsec},
                               {"twin, constant = linear", 0, 3},
                               {"twin, quadratic", 2, 4}};
constexpr Row at_extremum[] = {{"constant = linear", 0, 0, false, exact},
                               {"quadratic", 2, 1, false, exact},
                               {"series, linear", 0, 0, true, series_error_arcsec},
                               {"series, quadratic", 2, 1, true, series_error_arcsec},
                               {"twin, constant = linear", 0, 0},
                               {"twin, quadratic", 2, 1}};
constexpr Row in_real_time[] = {{"constant", 0, 0, false, live},
                                {"linear", 1, 1, false, live},
                                {"quadratic", 2, 2, false, live},
                                {"twin, constant", 0, 0, false, nullptr, Fit::extrapolation},
                                {"twin, linear", 1, 1, false, nullptr, Fit::extrapolation},
                                {"twin, quadratic", 2, 2, false, nullptr, Fit::extrapolation}};

}  // namespace

std::span<const Row> corrected(Region region) {
    return region == Region::crossing ? std::span{at_crossing} : std::span<const Row>{at_extremum};
}
std::span<const Row> delivered() { return in_real_time; }

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

std::vector<Series> drawn(const Axis& axis, std::span<const Row> rows) {
    const Region region = axis.case_at(axis.shown.front()).region;
    std::vector<Series> all;
    for (const Row& row : rows) {
        const Look look{row.name, row.colour, row.dashed};
        if (row.of)
            all.push_back(curve(look, axis.shown, [&](double x) { return row.of(axis.case_at(x), row.order); }));
        else
            all.push_back(twin_points(look, axis.measured, axis.results, row.fit, row.order,
                                      [region](const SubstitutionPoint& p) { return measured(p, region); }));
    }
    return all;
}

}  // namespace zlg::paper
