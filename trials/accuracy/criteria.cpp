#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "parts.hpp"
#include "worst.hpp"

namespace zlg::trials {
namespace {

constexpr Groups paper_and_loops{CaseGroup::paper, CaseGroup::loops};
constexpr Groups stationary{CaseGroup::paper, CaseGroup::grid,    CaseGroup::broadband,
                            CaseGroup::loops, CaseGroup::warm_up, CaseGroup::rest};

bool is_x1(const CaseFigures& c) { return c.name.ends_with("x1"); }

Verdict verdict_of(bool met) { return met ? Verdict::met : Verdict::missed; }

Worst worst_rms(const Accuracy& accuracy, bool x1, Groups groups, const std::string& method) {
    return worst_of(accuracy, groups, method, [&](const CaseFigures& c, const ErrorFigures& f, Worst& w) {
        if (is_x1(c) == x1) w.add(f.rms_arcsec, rms_error(f), c.name);
    });
}

void add_whole_switch(const Accuracy& accuracy, const std::string& method, std::vector<Criterion>& out) {
    const auto add = [&](const char* wanted, const Worst& w, double limit) {
        out.push_back({"a, f", fmt::format("{}: {}", method, wanted), w.text(), w.against(limit)});
    };
    add("paper's case and every loop, x1: rms at most 0.85\"", worst_rms(accuracy, true, paper_and_loops, method),
        0.85);
    add("the same, x4: at most 0.22\"", worst_rms(accuracy, false, paper_and_loops, method), 0.22);
    add("bias at most 0.2\", chi f0 wrong by 10 % included",
        worst_of(accuracy, paper_and_loops, method,
                 [](const CaseFigures& c, const ErrorFigures& f, Worst& w) {
                     w.add(std::abs(f.bias_arcsec), f.standard_error, c.name);
                 }),
        0.2);
    add("at most 1.15 times the bound",
        worst_of(accuracy, paper_and_loops, method,
                 [](const CaseFigures& c, const ErrorFigures& f, Worst& w) {
                     const double bound = c.bound.halves_arcsec;
                     if (bound > 0.0) w.add(f.rms_arcsec / bound, rms_error(f) / bound, c.name);
                 }),
        1.15);
}

void add_relock(const Accuracy& accuracy, std::vector<Criterion>& out) {
    Worst bias;
    Worst ratio;
    for (const RelockFigures& f : accuracy.relock) {
        bias.add(std::abs(f.error.bias_arcsec), f.error.standard_error, f.name);
        ratio.add(f.error.sd_arcsec / f.bound_arcsec, rms_error(f.error) / f.bound_arcsec, f.name);
    }
    out.push_back({"light", "false angle, every loop: bias at most 0.2\"", bias.text(), bias.against(0.2)});
    out.push_back(
        {"light", "false angle, every loop: sd at most 1.25 times the bound", ratio.text(), ratio.against(1.25)});
}

// rms over the axes of what `of` gives of each.
template <class Of> double pooled(const RecordingFigures& r, const Of& of) {
    double sum = 0.0;
    for (const AxisFigures& a : r.axes) sum += of(a) * of(a);
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, r.axes.size())));
}

double pooled_rms(const RecordingFigures& r, const char* method) {
    return pooled(r, [&](const AxisFigures& a) { return find_method(a.methods, method)->whole.rms_arcsec; });
}

void add_recording(const RecordingFigures& r, std::vector<Criterion>& out) {
    const double ours = pooled_rms(r, "auto");
    const double gain =
        std::min({pooled_rms(r, "constant"), pooled_rms(r, "linear"), pooled_rms(r, "quadratic")}) / ours;
    const double over_fit = ours / pooled(r, [](const AxisFigures& a) { return a.fit_rms_arcsec; });
    Worst axis;
    Worst outside;
    for (const AxisFigures& a : r.axes) {
        const ErrorFigures& f = find_method(a.methods, "auto")->whole;
        double of_paper = 1e300;
        for (const MethodFigures& p : a.methods)
            if (p.of_paper) of_paper = std::min(of_paper, p.whole.rms_arcsec);
        const std::string name = fmt::format("column {}", a.column);
        axis.add(f.rms_arcsec / of_paper, 0.0, name);
        outside.add(1.0 - f.within_3_sigma_ratio, 0.0, name);
    }
    const auto add = [&](const char* table, const char* wanted, const std::string& got, Verdict verdict) {
        out.push_back({table, fmt::format("{}: {}", r.name, wanted), got, verdict});
    };
    if (r.real) {
        add("e", "auto at least 1.30 times better than the best single method of the paper",
            fmt::format("{:.3f}", gain), verdict_of(gain >= 1.30));
        add("e", "auto at most 1.10 times the least-squares fit to the whole recording",
            fmt::format("{:.3f}", over_fit), verdict_of(over_fit <= 1.10));
    } else {
        // Where the fit itself is hardly better than a polynomial, nothing else can be.
        add("e", "auto at least 1.30 times better than the best of the paper, or at most 1.10 times the fit",
            fmt::format("{:.3f} or {:.3f}", gain, over_fit), verdict_of(gain >= 1.30 || over_fit <= 1.10));
    }
    add("e", "on no axis more than 2 % worse than the best of the three", axis.text(), axis.against(1.02));
    add("e", "at most 1 % beyond 3 sigma", outside.text(), outside.against(0.01));
}

// Whether the sigma that is claimed agrees with the error.
void add_consistency(const Accuracy& accuracy, const char* method, std::vector<Criterion>& out) {
    const auto greatest =
        worst_of(accuracy, stationary, method,
                 [](const CaseFigures& c, const ErrorFigures& f, Worst& w) { w.add(f.nev, nev_error(f), c.name); });
    // The least, as the greatest of 10 - NEV.
    const auto least = worst_of(
        accuracy, stationary, method,
        [](const CaseFigures& c, const ErrorFigures& f, Worst& w) { w.add(10.0 - f.nev, nev_error(f), c.name); });
    const auto outside = worst_of(
        accuracy, {CaseGroup::non_stationary}, method, [](const CaseFigures& c, const ErrorFigures& f, Worst& w) {
            // Standard error of a share of 1 %.
            w.add(1.0 - f.within_3_sigma_ratio, std::sqrt(0.01 / static_cast<double>(f.n)), c.name);
        });
    out.push_back({"a-h", fmt::format("{}: NEV at most 1.4 in (a)-(c), (f)-(h)", method), greatest.text(),
                   greatest.against(1.4)});
    out.push_back({"a-h", fmt::format("{}: NEV at least 0.25", method), least.value_text(10.0 - least.value),
                   least.against(10.0 - 0.25)});
    out.push_back(
        {"d", fmt::format("{}: at most 1 % beyond 3 sigma in (d)", method), outside.text(), outside.against(0.01)});
}

}  // namespace

std::vector<Criterion> criteria_of(const Accuracy& accuracy) {
    std::vector<Criterion> criteria;
    add_whole_switch(accuracy, method_name::automatic, criteria);
    add_relock(accuracy, criteria);
    for (const RecordingFigures& r : accuracy.recordings) add_recording(r, criteria);
    add_consistency(accuracy, method_name::automatic, criteria);
    add_manoeuvre_criteria(accuracy, criteria);
    add_gap_criteria(accuracy, criteria);
    return criteria;
}

}  // namespace zlg::trials
