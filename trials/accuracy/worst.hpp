#pragma once
// A figure that many cases have, its worst value, and what chance may have added to it.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include <fmt/format.h>

#include <zlg/trials/accuracy.hpp>

#include "parts.hpp"

namespace zlg::trials {

// Standard errors by which chance may exceed a limit.
inline constexpr double chance = 2.0;

using Groups = std::initializer_list<CaseGroup>;

// The greatest value of a figure over cases, where it is, and the greatest value less what chance may have added to it.
struct Worst {
    double value = -1.0;
    double standard_error = 0.0;
    double certain = -1e300;
    std::string where = "no case";

    void add(double x, double error, const std::string& name) {
        certain = std::max(certain, x - chance * error);
        if (x <= value) return;
        value = x;
        standard_error = error;
        where = name;
    }
    [[nodiscard]] Verdict against(double limit) const {
        if (!(value >= 0.0 && certain <= limit)) return Verdict::missed;
        return value <= limit ? Verdict::met : Verdict::within_chance;
    }
    [[nodiscard]] bool is_empty() const { return value < 0.0; }

    // The value, or what stands for it, with its standard error where it has one, and where it is.
    [[nodiscard]] std::string value_text(double shown) const {
        if (standard_error > 0.0) return fmt::format("{:.3g} +- {:.2g} ({})", shown, standard_error, where);
        return fmt::format("{:.3g} ({})", shown, where);
    }
    [[nodiscard]] std::string text() const { return value_text(value); }
};

inline double rms_error(const ErrorFigures& f) { return f.rms_arcsec / std::sqrt(2.0 * static_cast<double>(f.n)); }

// Of a chi-square variable of n degrees of freedom over n, the relative standard error.
inline double nev_error(const ErrorFigures& f) { return f.nev * std::sqrt(2.0 / static_cast<double>(f.n)); }

// measure(case, figures, worst)  adds what one method makes of one case.
template <class Measure>
Worst worst_of(const Accuracy& accuracy, Groups groups, const std::string& method, const Measure& measure) {
    Worst w;
    for (const CaseFigures& c : accuracy.cases) {
        const MethodFigures* m =
            std::ranges::find(groups, c.group) == groups.end() ? nullptr : find_method(c.methods, method);
        if (m != nullptr && m->whole.n > 0) measure(c, m->whole, w);
    }
    return w;
}

}  // namespace zlg::trials
