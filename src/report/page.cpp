#include <zlg/report/page.hpp>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "axes_json.hpp"
#include "page_files.hpp"
#include "text.hpp"

namespace zlg::report {
namespace {

constexpr std::size_t longest_without_contents = 3;
constexpr std::size_t longest_to_scroll_past = 24;

// What the page has numbered and named so far.
struct Counters {
    int n_tables = 0;
    int n_figures = 0;
    std::set<std::string> ids;
    bool shown = true;
};

std::string section_id(std::size_t index) { return fmt::format("section-{}", index + 1); }

// Plain text as the page shows it.
std::string shown(std::string_view text) { return escaped(typeset(text)); }

std::string paragraph(const std::string& text, const char* tag) {
    return text.empty() ? "" : fmt::format("<p{}>{}</p>\n", tag, shown(text));
}

std::string links(const Page& page) {
    std::string out;
    for (const Link& link : page.links)
        out += fmt::format("<p><a href=\"{}\">{}</a></p>\n", escaped(link.address), shown(link.text));
    return out;
}

std::string contents(const Page& page) {
    if (page.sections.size() <= longest_without_contents) return "";
    std::string out = "<nav aria-label=\"Contents\"><ol>\n";
    for (std::size_t i = 0; i < page.sections.size(); ++i) {
        out += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", section_id(i), shown(page.sections[i].heading));
    }
    return out + "</ol></nav>\n";
}

std::string_view cell_of(const std::vector<std::string>& row, std::size_t column) {
    return column < row.size() ? std::string_view{row[column]} : std::string_view{};
}

// Columns of nothing but numbers; the first names its row.
std::vector<bool> columns_of_numbers(const Table& table, std::size_t n_columns) {
    std::vector<bool> out(n_columns, true);
    for (std::size_t i = 0; i < n_columns; ++i)
        out[i] = i > 0 && std::ranges::all_of(table.rows, [i](const auto& row) { return is_number(cell_of(row, i)); });
    return out;
}

// Text in another column than the first, too long to scroll past.
bool has_long_text(const Table& table) {
    return std::ranges::any_of(table.rows, [](const auto& row) {
        return row.size() > 1 && std::any_of(row.begin() + 1, row.end(),
                                             [](const auto& cell) { return cell.size() > longest_to_scroll_past; });
    });
}

std::string header_row(const Table& table, const std::vector<bool>& numbers) {
    if (table.header.empty()) return "";
    std::string out = "<thead><tr>";
    for (std::size_t i = 0; i < numbers.size(); ++i)
        out += fmt::format("<th scope=\"col\"{}>{}</th>", numbers[i] ? " class=\"n\"" : "",
                           shown(cell_of(table.header, i)));
    return out + "</tr></thead>\n";
}

// Where rows are stacked each cell brings the name of its column.
std::string body_row(const Table& table, const std::vector<std::string>& row, const std::vector<bool>& numbers,
                     bool is_stack) {
    std::string out = "<tr><th scope=\"row\">" + shown(cell_of(row, 0)) + "</th>";
    for (std::size_t i = 1; i < numbers.size(); ++i) {
        const std::string is = is_stack ? fmt::format(" data-is=\"{}\"", shown(cell_of(table.header, i))) : "";
        out += fmt::format("<td{}{}>{}</td>", numbers[i] ? " class=\"n\"" : "", is,
                           cell_of(row, i) == "-" ? "\u2013" : shown(cell_of(row, i)));
    }
    return out + "</tr>\n";
}

// On a narrow screen the rows of a table with columns of text stand as stacks of lines; one of numbers scrolls in a box
// of its own, which takes the focus so that a keyboard can scroll it.
std::string table_of(const Table& table, Counters& counters) {
    std::size_t n_columns = table.header.size();
    for (const auto& row : table.rows) n_columns = std::max(n_columns, row.size());
    if (n_columns == 0) return "";
    const std::vector<bool> numbers = columns_of_numbers(table, n_columns);
    const bool is_stack = has_long_text(table);
    const std::string id = fmt::format("table-{}", ++counters.n_tables);
    const std::string number = counters.shown ? fmt::format("<b>Table {}.</b> ", counters.n_tables) : "";
    std::string out = fmt::format(
        "<figure class=\"table\">\n<figcaption id=\"{0}\">{1}{2}</figcaption>\n"
        "<div class=\"scroll{4}\" role=\"region\" tabindex=\"0\" aria-labelledby=\"{0}\">\n"
        "<table aria-labelledby=\"{0}\">\n{3}<tbody>\n",
        id, number, shown(table.caption), header_row(table, numbers), is_stack ? " stack" : "");
    for (const auto& row : table.rows) out += body_row(table, row, numbers, is_stack);
    return out + "</tbody>\n</table>\n</div>\n</figure>\n";
}

// What is beside a drawing: of a diagram there is no more to say.
std::string attributes_of(const Diagram&) { return ""; }
std::string attributes_of(const Figure& figure) {
    return fmt::format(" data-figure=\"{}\"", escaped(axes_json(figure)));
}

// A figure or a diagram.
template <class Drawing> std::string drawing_of(Drawing drawing, Counters& counters) {
    const std::string numbered = fmt::format("figure-{}", ++counters.n_figures);
    drawing.id = clean_id(drawing.id, numbered);
    if (!counters.ids.insert(drawing.id).second) {
        drawing.id = numbered + "-" + drawing.id;
        counters.ids.insert(drawing.id);
    }
    const std::string number = counters.shown ? fmt::format("Figure {}. ", counters.n_figures) : "";
    return fmt::format("<figure class=\"drawing\"{}>\n{}<figcaption><b>{}{}</b> {}</figcaption>\n</figure>\n",
                       attributes_of(drawing), svg(drawing), number,
                       shown(drawing.title.empty() ? "" : drawing.title + "."), shown(drawing.caption));
}

// Line by line, for a line's end is no space here.
std::string escaped_lines(std::string_view text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        out += escaped(text.substr(at, end - at)) + "\n";
        at = end + 1;
    }
    return out;
}

std::string section_of(const Section& section, std::size_t index, Counters& counters) {
    std::string out = fmt::format("<section id=\"{}\">\n", section_id(index));
    if (!section.heading.empty()) out += fmt::format("<h2>{}</h2>\n", shown(section.heading));
    for (const std::string& text : section.paragraphs) out += paragraph(text, "");
    for (const Table& table : section.tables) out += table_of(table, counters);
    std::string drawings;
    for (const Diagram& diagram : section.diagrams) drawings += drawing_of(diagram, counters);
    for (const Figure& figure : section.figures) drawings += drawing_of(figure, counters);
    if (!drawings.empty()) out += "<div class=\"figures\">\n" + drawings + "</div>\n";
    if (!section.code.empty()) out += fmt::format("<pre>{}</pre>\n", escaped_lines(section.code));
    return out + "</section>\n";
}

// No text of it may end the element.
std::string data_of(const Page& page) {
    if (page.data.empty()) return "";
    std::string out;
    for (const char c : page.data) out += c == '<' ? std::string{"\\u003c"} : std::string{c};
    return fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n", out);
}

std::string hint(const Page& page) {
    if (std::ranges::all_of(page.sections, [](const Section& s) { return s.figures.empty(); })) return "";
    return "<p class=\"hint\">Figures: point at a curve, or focus a figure and press the arrow keys, for its values; "
           "drag, or "
           "press + and \u2212, to zoom; double-click or Escape goes back; a name in a legend hides and shows its "
           "series.</p>\n";
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
        shown(page.title), page_css);
    out += paragraph(page.verdict, " class=\"verdict\"") + paragraph(page.lead, " class=\"lead\"") + links(page) +
           hint(page);
    out += "</header>\n" + contents(page) + "<main>\n";
    for (std::size_t i = 0; i < page.sections.size(); ++i) out += section_of(page.sections[i], i, counters);
    return out + fmt::format("</main>\n{}</body>\n<script>{}</script>\n</html>\n", data_of(page), page_js);
}

}  // namespace zlg::report
