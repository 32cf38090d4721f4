#include <fmt/format.h>

#include <zlg/report/number_text.hpp>

#include "accuracy_parts.hpp"
#include "accuracy_tables.hpp"

namespace zlg::trials {
namespace {

using report::Figure;
using report::Mark;
using report::Series;

Series points(std::string name) {
    return {.name = std::move(name), .x = {}, .y = {}, .y_error = {}, .mark = Mark::points};
}

// Error over bound of every case that has one, in the order of the table.
Figure ratio_figure(const Accuracy& accuracy) {
    Figure f = report::blank_figure(
        "ratio", "Error over bound",
        "Each place on the x axis is a case that has a bound, in the order of the tables. At 1 no linear method that "
        "does "
        "not know the constant rate can do better; below it a method makes use of that rate, or roundings repeat.",
        "case", "rms error over bound");
    f.log_y = true;
    for (const char* name :
         {method_name::automatic, method_name::optimal, method_name::quadratic, method_name::constant}) {
        Series s = points(name);
        double place = 0.0;
        for (const CaseFigures& c : accuracy.cases) {
            if (!(c.bound.halves > 0.0)) continue;
            place += 1.0;
            const MethodFigures* m = find_method(c.methods, name);
            if (m == nullptr) continue;
            s.x.push_back(place);
            s.y.push_back(m->whole.rms_arcsec / c.bound.halves);
        }
        f.series.push_back(std::move(s));
    }
    return f;
}

Figure honesty_figure(const Accuracy& accuracy) {
    Figure f =
        report::blank_figure("nev", "Error over claimed sigma",
                             "Mean of (error/sigma)^2 for each case. 1 is honest, above it a method claims too much. "
                             "The paper's polynomials take "
                             "the motion as one of their own kind.",
                             "case", "NEV");
    f.log_y = true;
    for (const char* name : {method_name::automatic, method_name::optimal, method_name::quadratic}) {
        Series s = points(name);
        double place = 0.0;
        for (const CaseFigures& c : accuracy.cases) {
            place += 1.0;
            const MethodFigures* m = find_method(c.methods, name);
            if (m == nullptr || m->whole.claimed == 0) continue;
            s.x.push_back(place);
            s.y.push_back(m->whole.nev);
        }
        f.series.push_back(std::move(s));
    }
    return f;
}

}  // namespace

report::Page accuracy_page(const Accuracy& accuracy) {
    report::Page page;
    page.title = "Accuracy of a switch";
    page.lead =
        "Every way of bridging a gap and of correcting the re-lock, on the same records, beside the least error that "
        "is possible. Errors are permanent ones of the angle, per switch.";
    std::vector<TableOfAccuracy> tables = tables_of(accuracy);
    for (TableOfAccuracy& t : detailed_tables_of(accuracy)) tables.push_back(std::move(t));
    for (TableOfAccuracy& t : tables) {
        report::Section section;
        section.heading = t.heading;
        t.table.caption = t.words;
        section.tables = {std::move(t.table)};
        page.sections.push_back(std::move(section));
    }
    page.sections.front().figures = {ratio_figure(accuracy), honesty_figure(accuracy)};
    return page;
}

}  // namespace zlg::trials
