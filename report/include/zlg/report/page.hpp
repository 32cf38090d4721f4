#pragma once
// One self-contained HTML page: no script, no style sheet, no picture from outside.

#include <string>
#include <vector>

#include <zlg/report/figure.hpp>

namespace zlg::report {

struct Table {
    std::string caption;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;  // text; the first column is left-aligned, the others right-aligned
};

struct Section {
    std::string heading;
    std::vector<std::string> paragraphs;  // plain text, escaped by the page
    std::vector<Table> tables;
    std::vector<Figure> figures;
};

struct Page {
    std::string title;
    std::string lead;  // one or two sentences under the title
    std::vector<Section> sections;
};

[[nodiscard]] std::string html(const Page& page);

}  // namespace zlg::report
