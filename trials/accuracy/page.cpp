// The tables of a campaign as Markdown and, with every method in every case, as a page.

#include <fmt/format.h>

#include <zlg/report/number_text.hpp>

#include "parts.hpp"

namespace zlg::trials {
namespace {

using report::Figure;

std::string row_text(const std::vector<std::string>& cells) { return fmt::format("| {} |\n", fmt::join(cells, " | ")); }

// One point of each method for each case, at the case's place in the order of the tables.
//
// cases_with  whether a case has a place; value  what is drawn of a method in it, not above 0: nothing.
template <class With, class Value>
void add_points(Figure& f, const Accuracy& accuracy, std::initializer_list<const char*> methods, const With& cases_with,
                const Value& value) {
    f.log_y = true;
    for (const char* name : methods) {
        report::Series s{.name = name, .mark = report::Mark::points};
        double place = 0.0;
        for (const CaseFigures& c : accuracy.cases) {
            if (!cases_with(c)) continue;
            place += 1.0;
            const MethodFigures* m = find_method(c.methods, name);
            if (m == nullptr || !(value(c, m->whole) > 0.0)) continue;
            s.x.push_back(place);
            s.y.push_back(value(c, m->whole));
        }
        f.series.push_back(std::move(s));
    }
}

Figure ratio_figure(const Accuracy& accuracy) {
    Figure f = report::blank_figure(
        "ratio", "Error over bound",
        "Each place on the x axis is a case that has a bound, in the order of the tables. At 1 no linear method that "
        "does not know the constant rate can do better; below it a method makes use of that rate, or roundings repeat.",
        "case", "rms error over bound");
    add_points(
        f, accuracy, {method_name::automatic, method_name::quadratic, method_name::constant},
        [](const CaseFigures& c) { return c.bound.halves_arcsec > 0.0; },
        [](const CaseFigures& c, const ErrorFigures& e) { return e.rms_arcsec / c.bound.halves_arcsec; });
    return f;
}

Figure nev_figure(const Accuracy& accuracy) {
    Figure f =
        report::blank_figure("nev", "Error over claimed sigma",
                             "Mean of (error/sigma)^2 for each case. 1 is honest, above it a method claims too much. "
                             "The paper's polynomials take the motion as one of their own kind.",
                             "case", "NEV");
    add_points(
        f, accuracy, {method_name::automatic, method_name::quadratic}, [](const CaseFigures&) { return true; },
        [](const CaseFigures&, const ErrorFigures& e) { return e.nev; });
    return f;
}

// What one method makes of a readout over the sweep of frequencies.
report::Series sweep(const Accuracy& accuracy, const char* label, const char* method, const std::string& readout) {
    report::Series s{.name = fmt::format("{}, {}", label, readout)};
    for (const CaseFigures& c : accuracy.cases) {
        if (c.swept_hz == 0.0 || !c.name.ends_with(readout)) continue;
        s.x.push_back(c.swept_hz);
        s.y.push_back(find_method(c.methods, method)->whole.rms_arcsec);
    }
    return s;
}

}  // namespace

Figure frequency_figure(const Accuracy& accuracy) {
    Figure f = report::blank_figure("frequency", "Error of a switch against the frequency of the motion",
                                    "A sine of 12 000 arcsec/s, a gap of 3 ticks and a miss of 0.22 wavelength. The "
                                    "paper's polynomials at one count a fringe; the default at one count, four counts "
                                    "and by the phase.",
                                    "frequency, Hz", "rms error of a switch, arcsec");
    f.log_x = f.log_y = true;
    f.series = {sweep(accuracy, "constant", method_name::constant, readouts[0]),
                sweep(accuracy, "quadratic", method_name::quadratic, readouts[0])};
    for (const char* readout : readouts) f.series.push_back(sweep(accuracy, "auto", method_name::automatic, readout));
    return f;
}

std::string markdown(const Accuracy& accuracy) {
    std::string text;
    for (const report::Section& s : tables_of(accuracy)) {
        const report::Table& t = s.tables.front();
        text += fmt::format("## {}\n\n{}\n\n{}|", s.heading, t.caption, row_text(t.header));
        for (std::size_t k = 0; k < t.header.size(); ++k) text += "---|";
        text += "\n";
        for (const auto& row : t.rows) text += row_text(row);
        text += "\n";
    }
    return text;
}

report::Page accuracy_page(const Accuracy& accuracy) {
    report::Page page;
    page.title = "Accuracy of a switch";
    page.lead =
        "Every way of bridging a gap and of correcting the re-lock, on the same records, beside the least error that "
        "is possible. Errors are permanent ones of the angle, per switch.";
    page.sections = tables_of(accuracy);
    for (report::Section& s : detailed_tables_of(accuracy)) page.sections.push_back(std::move(s));
    page.sections.front().figures = {ratio_figure(accuracy), nev_figure(accuracy)};
    // The quick campaign has no sweep.
    if (!accuracy.task.quick) page.sections.front().figures.push_back(frequency_figure(accuracy));
    return page;
}

}  // namespace zlg::trials
