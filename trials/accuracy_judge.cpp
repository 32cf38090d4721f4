#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "accuracy_parts.hpp"

namespace zlg::trials {
namespace {

// Beyond a limit only where chance does not explain it: two standard errors.
constexpr double chance = 2.0;

bool is_x1(const CaseFigures& c) { return c.name.ends_with("x1"); }

double min_bound(const CaseFigures& c) { return c.bound.halves; }

// The worst over cases of what one method makes of them, where, and what is left of it without what chance may have added.
struct Worst {
    double value = -1.0;
    double certain = -1e300;
    std::string where = "no case";

    void see(double x, double slack, const std::string& name) {
        certain = std::max(certain, x - slack);
        if (x <= value) return;
        value = x;
        where = name;
    }
    [[nodiscard]] Verdict against(double limit) const {
        if (!(value >= 0.0 && certain <= limit)) return Verdict::missed;
        return value <= limit ? Verdict::met : Verdict::within_chance;
    }
    [[nodiscard]] std::string text() const { return fmt::format("{:.3g} ({})", value, where); }
};

Verdict verdict_of(bool met) { return met ? Verdict::met : Verdict::missed; }

class Bench {
public:
    explicit Bench(const Accuracy& accuracy) : accuracy_{accuracy} {}

    template <class Take>
    Worst worst(const std::string& groups, const std::string& method, const Take& take) const {
        Worst w;
        for (const CaseFigures& c : accuracy_.cases) {
            const MethodFigures* m =
                groups.find(c.group) == std::string::npos ? nullptr : find_method(c.methods, method);
            if (m != nullptr && m->whole.n > 0) take(c, *m, w);
        }
        return w;
    }

    Worst rms(bool x1, const std::string& groups, const std::string& method) const {
        return worst(groups, method, [&](const CaseFigures& c, const MethodFigures& m, Worst& w) {
            if (is_x1(c) == x1) w.see(m.whole.rms_arcsec, chance * rms_error(m.whole), c.name);
        });
    }

    Worst bias(const std::string& groups, const std::string& method) const {
        return worst(groups, method, [&](const CaseFigures& c, const MethodFigures& m, Worst& w) {
            w.see(std::abs(m.whole.bias_arcsec), chance * m.whole.standard_error, c.name);
        });
    }

    Worst ratio(const std::string& groups, const std::string& method) const {
        return worst(groups, method, [&](const CaseFigures& c, const MethodFigures& m, Worst& w) {
            if (!(min_bound(c) > 0.0)) return;
            w.see(m.whole.rms_arcsec / min_bound(c), chance * rms_error(m.whole) / min_bound(c), c.name);
        });
    }

    [[nodiscard]] static double rms_error(const ErrorFigures& f) {
        return f.rms_arcsec / std::sqrt(2.0 * static_cast<double>(f.n));
    }

private:
    const Accuracy& accuracy_;
};

void add_whole_switch(const Bench& bench, const std::string& method, std::vector<Criterion>& out) {
    const auto add = [&](const char* wanted, const Worst& w, double limit) {
        out.push_back({"1", fmt::format("{}: {}", method, wanted), w.text(), w.against(limit)});
    };
    add("paper's case and every loop, x1: rms at most 2.0\"", bench.rms(true, "af", method), 2.0);
    add("the same, x4: at most 0.6\"", bench.rms(false, "af", method), 0.6);
    add("bias at most 0.2\", chi f0 wrong by 1 % included", bench.bias("af", method), 0.2);
    add("at most 1.15 times the bound", bench.ratio("af", method), 1.15);
}

void add_flat(const Bench& bench, std::vector<Criterion>& out) {
    const Worst x1 = bench.rms(true, "a", method_name::flat);
    const Worst x4 = bench.rms(false, "a", method_name::flat);
    out.push_back({"1", "fixed flat prior, x1: at most 5.5\"", x1.text(), x1.against(5.5)});
    out.push_back({"1", "fixed flat prior, x4: at most 2.6\"", x4.text(), x4.against(2.6)});
}

void add_relock(const Accuracy& accuracy, std::vector<Criterion>& out) {
    Worst bias;
    Worst ratio;
    for (const RelockFigures& f : accuracy.relock) {
        bias.see(std::abs(f.error.bias_arcsec), chance * f.error.standard_error, f.name);
        ratio.see(f.error.sd_arcsec / f.bound_arcsec, chance * Bench::rms_error(f.error) / f.bound_arcsec, f.name);
    }
    out.push_back({"2", "false angle, every loop: bias at most 0.2\"", bias.text(), bias.against(0.2)});
    out.push_back({"2", "false angle, every loop: sd at most 1.25 times the bound", ratio.text(), ratio.against(1.25)});
}

// rms over the axes.
double pooled(const RecordingFigures& r, const std::string& method) {
    double sum = 0.0;
    for (const AxisFigures& a : r.axes) {
        const MethodFigures* m = find_method(a.methods, method);
        if (m != nullptr) sum += m->whole.rms_arcsec * m->whole.rms_arcsec;
    }
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, r.axes.size())));
}

void add_recording(const RecordingFigures& r, std::vector<Criterion>& out) {
    const double ours = pooled(r, "auto");
    const double best = std::min({pooled(r, "constant"), pooled(r, "linear"), pooled(r, "quadratic")});
    double fit = 0.0;
    Worst axis;
    Worst outside;
    for (const AxisFigures& a : r.axes) {
        const MethodFigures* m = find_method(a.methods, "auto");
        double of_paper = 1e300;
        for (const MethodFigures& p : a.methods)
            if (p.of_paper) of_paper = std::min(of_paper, p.whole.rms_arcsec);
        const std::string name = fmt::format("column {}", a.column);
        axis.see(m->whole.rms_arcsec / of_paper, 0.0, name);
        outside.see(1.0 - m->whole.within_3_sigma_ratio, 0.0, name);
        fit += a.fit_rms_arcsec * a.fit_rms_arcsec;
    }
    fit = std::sqrt(fit / static_cast<double>(std::max<std::size_t>(1, r.axes.size())));
    const auto add = [&](const char* number, const std::string& wanted, const std::string& got, Verdict verdict) {
        out.push_back({number, fmt::format("{}: {}", r.name, wanted), got, verdict});
    };
    if (r.real) {
        add("3", "auto at least 1.30 times better than the best single method of the paper",
            fmt::format("{:.3f}", best / ours), verdict_of(best / ours >= 1.30));
        add("3", "auto at most 1.10 times the least-squares fit to the whole recording",
            fmt::format("{:.3f}", ours / fit), verdict_of(ours / fit <= 1.10));
    } else {
        // Where the fit itself is hardly better than a polynomial, nothing else can be.
        add("3", "auto at least 1.30 times better than the best of the paper, or at most 1.10 times the fit",
            fmt::format("{:.3f} or {:.3f}", best / ours, ours / fit),
            verdict_of(best / ours >= 1.30 || ours / fit <= 1.10));
    }
    add("3", "on no axis more than 2 % worse than the best of the three", axis.text(), axis.against(1.02));
    add("4", "at most 1 % beyond 3 sigma", outside.text(), outside.against(0.01));
}

void add_honesty(const Bench& bench, std::vector<Criterion>& out) {
    for (const char* method : {method_name::optimal, method_name::automatic}) {
        const auto most = bench.worst("abcfgh", method, [](const CaseFigures& c, const MethodFigures& m, Worst& w) {
            w.see(m.whole.nev, chance * m.whole.nev * std::sqrt(2.0 / static_cast<double>(m.whole.n)), c.name);
        });
        // The least, by its negative: the greatest of 10 - NEV.
        const auto least = bench.worst("abcfgh", method, [](const CaseFigures& c, const MethodFigures& m, Worst& w) {
            w.see(10.0 - m.whole.nev, chance * m.whole.nev * std::sqrt(2.0 / static_cast<double>(m.whole.n)), c.name);
        });
        const auto outside = bench.worst("d", method, [](const CaseFigures& c, const MethodFigures& m, Worst& w) {
            const double share = 1.0 - m.whole.within_3_sigma_ratio;
            w.see(share, chance * std::sqrt(0.01 / static_cast<double>(m.whole.n)), c.name);
        });
        out.push_back(
            {"4", fmt::format("{}: NEV at most 1.5 in (a)-(c), (f)-(h)", method), most.text(), most.against(1.5)});
        out.push_back({"4", fmt::format("{}: NEV at least 0.6", method),
                       fmt::format("{:.3g} ({})", 10.0 - least.value, least.where), least.against(10.0 - 0.6)});
        out.push_back(
            {"4", fmt::format("{}: at most 1 % beyond 3 sigma in (d)", method), outside.text(), outside.against(0.01)});
    }
}

}  // namespace

std::vector<Criterion> judge(const Accuracy& accuracy) {
    const Bench bench{accuracy};
    std::vector<Criterion> criteria;
    for (const char* method : {method_name::optimal, method_name::automatic}) add_whole_switch(bench, method, criteria);
    add_flat(bench, criteria);
    add_relock(accuracy, criteria);
    for (const RecordingFigures& r : accuracy.recordings) add_recording(r, criteria);
    add_honesty(bench, criteria);
    return criteria;
}

}  // namespace zlg::trials
