#pragma once
// Curves of formulas, as series of a figure.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <zlg/report/figure.hpp>

namespace zlg::paper {

struct Look {
    std::string name;
    int colour = -1;  // as in report::Series
    bool dashed = false;
};

template <class Formula> [[nodiscard]] report::Series curve(Look look, std::vector<double> x, const Formula& y_of) {
    report::Series s{.name = std::move(look.name), .x = std::move(x), .dashed = look.dashed, .colour = look.colour};
    for (const double at : s.x) s.y.push_back(y_of(at));
    return s;
}

[[nodiscard]] inline std::vector<double> evenly(double from, double to, int n) {
    std::vector<double> x;
    for (int i = 0; i < n; ++i) x.push_back(from + (to - from) * i / (n - 1.0));
    return x;
}

[[nodiscard]] inline std::vector<double> log_spaced(double from, double to, int n) {
    std::vector<double> x;
    for (int i = 0; i < n; ++i) x.push_back(from * std::pow(to / from, i / (n - 1.0)));
    x.back() = to;
    return x;
}

}  // namespace zlg::paper
