// Tables 1 and 2: false drift after re-lock as printed, on the twin, and on loops fitted to the measured drift.

#include <algorithm>
#include <numeric>

#include <zlg/design/relock_tables.hpp>
#include <zlg/report/number_text.hpp>

#include "paper_parts.hpp"
#include "paper_words.hpp"

namespace zlg::paper {
namespace {

using namespace design;

using Correction = TickDrifts (*)(const design::RelockModel&);
using Fits = std::vector<RelockFit>;

// Loops fitted to the measured drift. The third is the one that explains the tables.
Fits fitted_loops() {
    Fits fits;
    for (const Decay decay : {Decay::exponential, Decay::slew, Decay::slew_tail, Decay::critical})
        fits.push_back(design::fit_relock(decay, measured_arcsec_s));
    return fits;
}
constexpr std::size_t slew_tail = 2;

design::TableSummary left_by(Correction correction, const RelockFit& fit) {
    return summarise(fit.drift_arcsec_s, correction(fit.model));
}

double angle_arcsec(const TickDrifts& drift) { return summarise(drift, {}).angle_arcsec; }

// As many ticks of the twin as the tables have, if the run holds that many.
std::vector<double> twin_drift(const study::RunResult& run) {
    const auto n = std::min<std::size_t>(design::table_ticks, run.relock_false_drift_deg_h.size());
    return {run.relock_false_drift_deg_h.begin(),
            run.relock_false_drift_deg_h.begin() + static_cast<std::ptrdiff_t>(n)};
}

// --- the table as printed, with the twin beside it -------------------------------------------------------------------

struct PrintedTable {
    int number = 0;
    TickDrifts computed_deg_h{};
    const char* mean_measured = "";  // the sums as printed
    const char* mean_left = "";
    const char* angle_measured = "";
    const char* angle_left = "";
    const char* rest_measured = "";  // without tick 1
    const char* rest_left = "";
};

constexpr PrintedTable printed_1{1, design::table1_computed_arcsec_s, "2131", "1362", "43", "27", "22", "7"};
constexpr PrintedTable printed_2{2, design::table2_computed_arcsec_s, "2131", "166", "43", "3.3", "", ""};

std::string beside(double ours, const char* printed) {
    const std::string number = report::fixed_number(ours, 2);
    return *printed == '\0' ? number : fmt::format("{} (printed {})", number, printed);
}

report::Table printed_table(const PrintedTable& printed, const study::RunResult& run) {
    const auto raw = summarise(measured_arcsec_s, {});
    const auto left = summarise(measured_arcsec_s, printed.computed_deg_h);
    const std::vector<double> twin = twin_drift(run);
    const bool whole = twin.size() == design::table_ticks;
    const double twin_sum = std::accumulate(twin.begin(), twin.end(), 0.0);
    std::vector<std::vector<std::string>> rows;
    const auto whole_number = [](double x) { return report::fixed_number(x, 0); };
    for (std::size_t i = 0; i < design::table_ticks; ++i) {
        const bool corrected = i > 0 || printed.number == 2;
        rows.push_back({fmt::format("{}", i + 1), whole_number(measured_arcsec_s[i]),
                        corrected ? whole_number(printed.computed_deg_h[i]) : "not corrected",
                        whole_number(left.residual_arcsec_s[i]), i < twin.size() ? whole_number(twin[i]) : "-"});
    }
    const auto sums = [&](const char* name, const std::string& measured, const std::string& residual, double of_twin) {
        rows.push_back({name, measured, "", residual, whole ? report::fixed_number(of_twin, 2) : "-"});
    };
    sums("mean", beside(raw.mean_arcsec_s, printed.mean_measured), beside(left.mean_arcsec_s, printed.mean_left),
         twin_sum / design::table_ticks);
    sums("angle of four ticks, arcsec", beside(raw.angle_arcsec, printed.angle_measured),
         beside(left.angle_arcsec, printed.angle_left), design::table_tick_s * twin_sum);
    sums("angle without tick 1, arcsec", beside(raw.angle_without_first_arcsec, printed.rest_measured),
         beside(left.angle_without_first_arcsec, printed.rest_left),
         whole ? design::table_tick_s * (twin_sum - twin[0]) : 0.0);
    return table_of("table.printed", std::move(rows), {printed.number});
}

// --- loops fitted to the measured drift ------------------------------------------------------------------------------

report::Table model_table(const Fits& fits, const char* equation, Correction correction) {
    std::vector<std::vector<std::string>> rows;
    for (const RelockFit& fit : fits) {
        const auto add = [&](const std::string& name, const TickDrifts& drift, int decimals) {
            std::vector<std::string>& row = rows.emplace_back(1, name);
            for (const double x : drift) row.push_back(report::fixed_number(x, 0));
            row.push_back(report::fixed_number(angle_arcsec(drift), decimals));
        };
        add(fmt::format("{}: false drift", fit.name), fit.drift_arcsec_s, 1);
        add(fmt::format("by {}", equation), correction(fit.model), 1);
        add("left", left_by(correction, fit).residual_arcsec_s, 2);
    }
    return table_of("table.loops", std::move(rows), {equation});
}

// --- the text --------------------------------------------------------------------------------------------------------

std::string list_of(const Fits& fits) {
    std::string text;
    for (const RelockFit& fit : fits)
        text += fmt::format("{}{} {:.0f}", text.empty() ? "" : ", ", fit.name, fit.rms_arcsec_s);
    return text;
}

std::string per_switch(const study::RunResult& run, const std::string& name) {
    for (const study::VariantResult& v : run.variants)
        if (v.name == name && v.switch_error)
            return " " + words("table.per switch", {v.switch_error->mean_arcsec}).front();
    return "";
}

std::string sum_of_twin(const study::RunResult& run) {
    const std::vector<double> twin = twin_drift(run);
    if (twin.size() < design::table_ticks) return "";
    return " " + words("table.of the twin", {design::table_tick_s * std::accumulate(twin.begin(), twin.end(), 0.0),
                                             angle_arcsec(measured_arcsec_s)})
                     .front();
}

Values numbers_of_table_1(const Fits& fits, const study::RunResult& run) {
    const auto tau = design::local_time_constants_s(measured_arcsec_s);
    const RelockFit& fit = fits[slew_tail];
    const auto left = left_by(design::corrected_by_frequency_arcsec_s, fit);
    const TickDrifts& rest = left.residual_arcsec_s;
    const auto printed = summarise(measured_arcsec_s, design::table1_computed_arcsec_s);
    return {printed.mean_arcsec_s, rest[1], rest[2], rest[3], printed.residual_arcsec_s[1],
            printed.residual_arcsec_s[2], printed.residual_arcsec_s[3], sum_of_twin(run),
            // does not:
            1e3 * tau[0], 1e3 * tau[1], 1e3 * tau[2], list_of(fits),
            // nor need tick 1 be given up:
            angle_arcsec({fit.drift_arcsec_s[0], rest[1], rest[2], rest[3]}), left.angle_arcsec,
            per_switch(run, "relock_frequency")};
}

Values numbers_of_table_2(const RelockFit& fit, const study::RunResult& run) {
    const auto printed = summarise(measured_arcsec_s, design::table2_computed_arcsec_s);
    return {left_by(design::corrected_by_detuning_arcsec_s, fit).angle_arcsec, per_switch(run, "relock_detuning"),
            printed.angle_arcsec, printed.rms_arcsec_s};
}

}  // namespace

PaperItem paper_table_1(const PaperTask&, const study::RunResult& run) {
    const Fits fits = fitted_loops();
    return item_of("table 1", numbers_of_table_1(fits, run),
                   {printed_table(printed_1, run), model_table(fits, "(11)", design::corrected_by_frequency_arcsec_s)},
                   {});
}

PaperItem paper_table_2(const PaperTask&, const study::RunResult& run) {
    const Fits fits = fitted_loops();
    return item_of("table 2", numbers_of_table_2(fits[slew_tail], run),
                   {printed_table(printed_2, run), model_table(fits, "(13)", design::corrected_by_detuning_arcsec_s)},
                   {});
}

}  // namespace zlg::paper
