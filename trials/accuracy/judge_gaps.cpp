// Limits of gap lengths, of the first gap, of a motion that changes at the gap, of the phase and of lit halves.

#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <zlg/core/common/maths.hpp>

#include "parts.hpp"
#include "worst.hpp"

namespace zlg::trials {
namespace {

// Standard error of the mean of (error/sigma)^2 where the figures are the squares of normal variables.
void add_nev(const ErrorFigures& f, const std::string& name, Worst& greatest, Worst& least) {
    greatest.add(f.nev, nev_error(f), name);
    least.add(10.0 - f.nev, nev_error(f), name);
}

struct Limits {
    double least, most;
};

// NEV of a group within limits, both ends; of its cases whose name holds `part`.
void add_nev_limits(const Accuracy& accuracy, CaseGroup group, const char* table, const char* what, Limits limits,
                    std::vector<Criterion>& out, std::string_view part = {}) {
    Worst greatest;
    Worst least;
    for (const CaseFigures& c : accuracy.cases) {
        const bool counts = c.group == group && c.name.find(part) != std::string::npos;
        const MethodFigures* m = counts ? find_method(c.methods, method_name::automatic) : nullptr;
        if (m != nullptr && m->whole.claimed > 0) add_nev(m->whole, c.name, greatest, least);
    }
    if (greatest.is_empty()) return;
    out.push_back(
        {table, fmt::format("{}: NEV at most {}", what, limits.most), greatest.text(), greatest.against(limits.most)});
    out.push_back({table, fmt::format("{}: NEV at least {}", what, limits.least), least.value_text(10.0 - least.value),
                   least.against(10.0 - limits.least)});
}

const ErrorFigures* find_whole(const Accuracy& accuracy, CaseGroup group, const std::string& name) {
    for (const CaseFigures& c : accuracy.cases) {
        if (c.group != group || c.name != name) continue;
        const MethodFigures* m = find_method(c.methods, method_name::automatic);
        return m == nullptr ? nullptr : &m->whole;
    }
    return nullptr;
}

// Of one case, where the campaign has it.
void add_rms_limit(const Accuracy& accuracy, CaseGroup group, const std::string& name, const char* table,
                   const std::string& what, double limit, std::vector<Criterion>& out) {
    const ErrorFigures* f = find_whole(accuracy, group, name);
    if (f == nullptr) return;
    Worst w;
    w.add(f->rms_arcsec, rms_error(*f), name);
    out.push_back({table, fmt::format("{}: rms at most {}\"", what, limit), w.text(), w.against(limit)});
}

void add_phase(const Accuracy& accuracy, std::vector<Criterion>& out) {
    for (const auto& [name, limit] : {std::pair{main_case::rest, 0.01},
                                      {main_case::tone, 0.012},
                                      {main_case::tone_with_walk, 0.045},
                                      {main_case::band, 0.32},
                                      {main_case::learnt_band, 0.32}})
        add_rms_limit(accuracy, CaseGroup::phase, fmt::format("{}, {}", name, readouts[2]), "m",
                      fmt::format("by phase, {}", name), limit, out);
}

// From 60 ticks after the start on.
void add_first_gaps(const Accuracy& accuracy, std::vector<Criterion>& out) {
    add_nev_limits(accuracy, CaseGroup::first_gap, "k", "first gap 60 to 300 ticks after the start", {0.3, 2.5}, out,
                   "gap at 60 to 300");
    for (const auto& [readout, limit] : {std::pair{readouts[0], 1.0}, std::pair{readouts[1], 0.3}})
        add_rms_limit(accuracy, CaseGroup::first_gap,
                      fmt::format("20.06 Hz, first gap at 60 to 300 ticks, {}", readout), "k",
                      fmt::format("the same over 20.06 Hz, {}", readout), limit, out);
}

void add_changes(const Accuracy& accuracy, std::vector<Criterion>& out) {
    Worst nev;
    for (const ManoeuvreFigures& f : accuracy.changes) {
        const ErrorFigures& ours = find_method(f.methods, method_name::automatic)->whole;
        nev.add(ours.nev, nev_error(ours), fmt::format("{}, {}", f.base, f.manoeuvre));
    }
    if (!nev.is_empty())
        out.push_back({"l", "another motion from the gap on: NEV at most 3", nev.text(), nev.against(3.0)});
}

// How much less a switch errs by the lit halves; as the inverse, so that the greatest is the worst.
void add_lit(const Accuracy& accuracy, std::vector<Criterion>& out) {
    const auto add = [&](const char* name, const char* wanted, double most) {
        Worst inverse;
        for (const char* readout : {readouts[0], readouts[1]}) {
            const ErrorFigures* dark = find_whole(accuracy, CaseGroup::lit, fmt::format("{}, {}", name, readout));
            const ErrorFigures* lit =
                find_whole(accuracy, CaseGroup::lit, fmt::format("{}{}, {}", name, lit_halves_name, readout));
            if (dark == nullptr || lit == nullptr) continue;
            const double ratio = lit->rms_arcsec / dark->rms_arcsec;
            inverse.add(
                ratio,
                ratio * core::maths::hypot(rms_error(*lit) / lit->rms_arcsec, rms_error(*dark) / dark->rms_arcsec),
                readout);
        }
        if (!inverse.is_empty())
            out.push_back({"n", fmt::format(fmt::runtime(wanted), name), inverse.text(), inverse.against(most)});
    };
    add(main_case::vibration, "lit halves, {}: error over that without them at most 1/2.5", 1.0 / 2.5);
    for (const auto& [readout, limit] : {std::pair{readouts[0], 9.5}, std::pair{readouts[1], 5.0}})
        add_rms_limit(accuracy, CaseGroup::lit, fmt::format("{}{}, {}", main_case::vibration, lit_halves_name, readout),
                      "n", fmt::format("lit halves, {}", readout), limit, out);
    add(main_case::tone, "lit halves, {}: error over that without them at most 1", 1.0);
}

void add_gap_lengths(const Accuracy& accuracy, std::vector<Criterion>& out) {
    Worst usual;
    Worst all;
    for (const GapLengthFigures& f : accuracy.gap_lengths) {
        const std::string name = fmt::format("{}, column {}, gap of {} ticks", f.recording, f.column, f.gap_ticks);
        usual.add(f.usual_rms_arcsec / f.usual_best_arcsec, 0.0, name);
        all.add(f.rms_arcsec / f.best_arcsec, 0.0, name);
    }
    if (usual.is_empty()) return;
    out.push_back({"o",
                   "real motion, gaps of 1 to 10 ticks: at most 1.05 times the best polynomial, without the worst 1 %",
                   usual.text(), usual.against(1.05)});
    out.push_back({"o", "the same with them: at most 1.25 times", all.text(), all.against(1.25)});
}

}  // namespace

void add_gap_criteria(const Accuracy& accuracy, std::vector<Criterion>& out) {
    add_nev_limits(accuracy, CaseGroup::gap_lengths, "j", "gaps of 1 to 10 ticks", {0.25, 1.4}, out);
    add_first_gaps(accuracy, out);
    add_changes(accuracy, out);
    add_phase(accuracy, out);
    add_nev_limits(accuracy, CaseGroup::phase, "m", "by phase", {0.2, 1.4}, out);
    add_lit(accuracy, out);
    add_gap_lengths(accuracy, out);
}

}  // namespace zlg::trials
