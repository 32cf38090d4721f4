#include <zlg/report/page.hpp>

#include <algorithm>
#include <cstddef>
#include <set>

#include <fmt/format.h>

#include "page_style.hpp"
#include "text.hpp"

namespace zlg::report {
namespace {

constexpr std::size_t longest_without_contents = 3;

// What the page has numbered and named so far.
struct Counters {
    int n_tables = 0;
    int n_figures = 0;
    std::set<std::string> ids;
    bool shown = true;
};

std::string section_id(std::size_t index) { return fmt::format("section-{}", index + 1); }

std::string contents(const Page& page) {
    if (page.sections.size() <= longest_without_contents) return "";
    std::string out = "<nav aria-label=\"Contents\"><ol>\n";
    for (std::size_t i = 0; i < page.sections.size(); ++i) {
        out += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section_id(i), escaped(page.sections[i].heading));
    }
    return out + "</ol></nav>\n";
}

std::string cell_of(const std::vector<std::string>& row, std::size_t column) {
    return column < row.size() ? escaped(row[column]) : "";
}

std::string header_row(const Table& table, std::size_t n_columns) {
    if (table.header.empty()) return "";
    std::string out = "<thead><tr>";
    for (std::size_t i = 0; i < n_columns; ++i) out += "<th scope=\"col\">" + cell_of(table.header, i) + "</th>";
    return out + "</tr></thead>\n";
}

std::string body_row(const std::vector<std::string>& row, std::size_t n_columns) {
    std::string out = "<tr><th scope=\"row\">" + cell_of(row, 0) + "</th>";
    for (std::size_t i = 1; i < n_columns; ++i) out += "<td>" + cell_of(row, i) + "</td>";
    return out + "</tr>\n";
}

// A table wider than the screen scrolls in a box of its own; the box takes the focus so that a keyboard can scroll it.
std::string table_of(const Table& table, Counters& counters) {
    std::size_t n_columns = table.header.size();
    for (const auto& row : table.rows) n_columns = std::max(n_columns, row.size());
    if (n_columns == 0) return "";
    const std::string id = fmt::format("table-{}", ++counters.n_tables);
    const std::string number = counters.shown ? fmt::format("<b>Table {}.</b> ", counters.n_tables) : "";
    std::string out = fmt::format(
        "<figure class=\"table\">\n<figcaption id=\"{0}\">{1}{2}</figcaption>\n"
        "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-labelledby=\"{0}\">\n"
        "<table{4} aria-labelledby=\"{0}\">\n{3}<tbody>\n",
        id, number, escaped(table.caption), header_row(table, n_columns), table.prose ? " class=\"prose\"" : "");
    for (const auto& row : table.rows) out += body_row(row, n_columns);
    return out + "</tbody>\n</table>\n</div>\n</figure>\n";
}

// A figure or a diagram.
template <class Drawing>
std::string drawing_of(Drawing drawing, Counters& counters) {
    const std::string numbered = fmt::format("figure-{}", ++counters.n_figures);
    drawing.id = clean_id(drawing.id, numbered);
    if (!counters.ids.insert(drawing.id).second) {
        drawing.id = numbered + "-" + drawing.id;
        counters.ids.insert(drawing.id);
    }
    const std::string number = counters.shown ? fmt::format("Figure {}. ", counters.n_figures) : "";
    return fmt::format("<figure class=\"drawing\">\n{}<figcaption><b>{}{}</b> {}</figcaption>\n</figure>\n",
                       svg(drawing), number, escaped(drawing.title.empty() ? "" : drawing.title + "."),
                       escaped(drawing.caption));
}

std::string section_of(const Section& section, std::size_t index, Counters& counters) {
    std::string out = fmt::format("<section id=\"{}\">\n", section_id(index));
    if (!section.heading.empty()) out += fmt::format("<h2>{}</h2>\n", escaped(section.heading));
    for (const std::string& paragraph : section.paragraphs) out += fmt::format("<p>{}</p>\n", escaped(paragraph));
    for (const Table& table : section.tables) out += table_of(table, counters);
    for (const Diagram& diagram : section.diagrams) out += drawing_of(diagram, counters);
    for (const Figure& figure : section.figures) out += drawing_of(figure, counters);
    return out + "</section>\n";
}

}  // namespace

std::string html(const Page& page) {
    Counters counters;
    counters.shown = page.numbered;
    for (std::size_t i = 0; i < page.sections.size(); ++i) counters.ids.insert(section_id(i));
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<header>\n<h1>{0}</h1>\n",
        escaped(page.title), page_style);
    if (!page.lead.empty()) out += fmt::format("<p class=\"lead\">{}</p>\n", escaped(page.lead));
    out += "</header>\n" + contents(page) + "<main>\n";
    for (std::size_t i = 0; i < page.sections.size(); ++i) out += section_of(page.sections[i], i, counters);
    return out + "</main>\n</body>\n</html>\n";
}

}  // namespace zlg::report
