#pragma once
// One self-contained HTML page: nothing comes from outside. It can be read and printed without its script, which adds
// values under the pointer, zoom, and series on and off.
//
// Texts are plain: the page escapes them and sets numbers as in print, "-1.5e-3" as a minus, a factor and a power of
// ten.

#include <string>
#include <vector>

#include <zlg/report/diagram.hpp>
#include <zlg/report/figure.hpp>

namespace zlg::report {

struct Table {
    std::string caption;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows{};  // a column of nothing but numbers is right-aligned; others wrap
};

struct Section {
    std::string heading;
    std::vector<std::string> paragraphs{};
    std::vector<Table> tables{};
    std::vector<Figure> figures{};
    std::vector<Diagram> diagrams{};  // drawn before the figures, numbered with them
    std::string code{};               // lines to copy, shown as they are, last
    bool is_of_page = false;          // what no text shows, such as how the page was made
};

struct Link {
    std::string text;
    std::string address;  // relative to the page, percent-encoded
};

struct Page {
    std::string title;
    std::string verdict;        // the result in one sentence, the first that is read
    std::string lead;           // one or two sentences under it
    std::vector<Link> links{};  // after the lead
    std::vector<Section> sections{};
    bool numbered = true;  // false where titles and captions bring numbers of their own
    std::string data{};    // JSON that a program finds in the page, in the element with the id `data`; empty: none
};

[[nodiscard]] std::string html(const Page& page);

// The same words and tables for a terminal, without figures; texts wrap, columns stand as wide as they need.
[[nodiscard]] std::string text(const Table& table);
[[nodiscard]] std::string text(const Page& page);

}  // namespace zlg::report
