#pragma once
// One self-contained HTML page: no script, no style sheet, no picture from outside.

#include <string>
#include <vector>

#include <zlg/report/diagram.hpp>
#include <zlg/report/figure.hpp>

namespace zlg::report {

struct Table {
    std::string caption;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows{};  // text; the first column is left-aligned, the others right-aligned
    bool prose = false;                            // every column is left-aligned text that wraps
};

struct Section {
    std::string heading;
    std::vector<std::string> paragraphs{};  // plain text, escaped by the page
    std::vector<Table> tables{};
    std::vector<Figure> figures{};
    std::vector<Diagram> diagrams{};  // drawn before the figures, numbered with them
};

struct Page {
    std::string title;
    std::string lead;  // one or two sentences under the title
    std::vector<Section> sections{};
    bool numbered = true;  // false where titles and captions bring numbers of their own
};

[[nodiscard]] std::string html(const Page& page);

}  // namespace zlg::report
