// Limits of first manoeuvres. Those that begin within the ticks before the gap, in it, or after it are one family.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "parts.hpp"
#include "worst.hpp"

namespace zlg::trials {
namespace {

// Kinds of a family: of one base, law, rate and duration.
struct Family {
    std::string name;
    std::vector<const ManoeuvreFigures*> kinds;

    [[nodiscard]] double n() const {
        double sum = 0.0;
        for (const ManoeuvreFigures* k : kinds) sum += static_cast<double>(ours(*k).n);
        return sum;
    }
    static const ErrorFigures& ours(const ManoeuvreFigures& f) {
        return find_method(f.methods, method_name::automatic)->whole;
    }
    // Mean over all gaps of what `of` gives of a kind.
    template <class Of> [[nodiscard]] double mean(const Of& of) const {
        double sum = 0.0;
        for (const ManoeuvreFigures* k : kinds) sum += static_cast<double>(ours(*k).n) * of(*k);
        return sum / n();
    }
    [[nodiscard]] double rms(std::size_t method) const {
        return std::sqrt(mean([&](const ManoeuvreFigures& f) {
            const double rms_arcsec = f.methods[method].whole.rms_arcsec;
            return rms_arcsec * rms_arcsec;
        }));
    }
};

std::vector<Family> families_of(const std::vector<ManoeuvreFigures>& all) {
    std::vector<Family> families;
    for (const ManoeuvreFigures& f : all) {
        if (f.manoeuvre.empty() || f.manoeuvre.ends_with(", ended before")) continue;
        const std::string name = fmt::format("{}, {}", f.base, f.manoeuvre.substr(0, f.manoeuvre.rfind(',')));
        if (families.empty() || families.back().name != name) families.push_back({name, {}});
        families.back().kinds.push_back(&f);
    }
    return families;
}

double over_best_polynomial(const Family& family) {
    const std::vector<MethodFigures>& methods = family.kinds.front()->methods;
    double ours = 0.0;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < methods.size(); ++m)
        (methods[m].of_paper ? best : ours) = methods[m].of_paper ? std::min(best, family.rms(m)) : family.rms(m);
    return ours / best;
}

double median_of(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

}  // namespace

void add_manoeuvre_criteria(const Accuracy& accuracy, std::vector<Criterion>& out) {
    Worst polynomial;
    Worst nev;
    Worst outside;
    std::vector<double> nevs;
    for (const Family& family : families_of(accuracy.manoeuvres)) {
        // Both errors are those of the same gaps, but as if they were independent.
        const double ratio = over_best_polynomial(family);
        polynomial.add(ratio, ratio / std::sqrt(family.n()), family.name);
        nevs.push_back(family.mean([](const ManoeuvreFigures& f) { return Family::ours(f).nev; }));
        nev.add(nevs.back(), nevs.back() * std::sqrt(2.0 / family.n()), family.name);
        outside.add(1.0 - family.mean([](const ManoeuvreFigures& f) { return Family::ours(f).within_3_sigma_ratio; }),
                    std::sqrt(0.07 / family.n()), family.name);
    }
    Worst onset;
    for (const ManoeuvreFigures& f : accuracy.manoeuvres) {
        if (f.manoeuvre.empty()) continue;
        const ErrorFigures& ours = Family::ours(f);
        onset.add(ours.nev, nev_error(ours), fmt::format("{}, {}", f.base, f.manoeuvre));
    }
    if (nevs.empty()) return;
    const auto add = [&](const char* wanted, const Worst& w, double limit) {
        out.push_back({"i", fmt::format("first manoeuvres: {}", wanted), w.text(), w.against(limit)});
    };
    add("at most 1.1 times the best polynomial", polynomial, 1.1);
    add("NEV of a family at most 5", nev, 5.0);
    add("NEV of one place of the onset at most 15", onset, 15.0);
    add("at most 7 % of a family beyond 3 sigma", outside, 0.07);
    const double median = median_of(nevs);
    out.push_back({"i", "first manoeuvres: NEV, median over the families .4 to 1.5", fmt::format("{:.3g}", median),
                   median >= 0.4 && median <= 1.5 ? Verdict::met : Verdict::missed});
}

}  // namespace zlg::trials
