#include <zlg/report/page.hpp>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "text.hpp"

namespace zlg::report {
namespace {

constexpr std::size_t line_width = 100;
constexpr std::size_t widest_words = 24;  // of a column of words beside many others
constexpr std::size_t most_free_columns = 3;
constexpr std::size_t narrowest_header = 9;  // of more letters than that

using Lines = std::vector<std::string>;

std::size_t width_of(std::string_view text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

Lines wrapped(std::string_view text, std::size_t width) {
    Lines lines{""};
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", at), text.size());
        const std::string_view word = text.substr(at, end - at);
        if (!lines.back().empty() && width_of(lines.back()) + 1 + width_of(word) > width) lines.emplace_back();
        if (!lines.back().empty()) lines.back() += ' ';
        lines.back() += word;
        at = end + 1;
    }
    return lines;
}

std::string flowed(const std::string& text) {
    return text.empty() ? "" : fmt::format("{}\n", fmt::join(wrapped(text, line_width), "\n"));
}

struct Column {
    bool is_number = false;
    std::size_t width = 0;
};

std::string cell_at(const Lines& row, std::size_t column) { return column < row.size() ? row[column] : std::string{}; }

std::vector<Column> columns_of(const Table& table) {
    std::size_t n = table.header.size();
    for (const Lines& row : table.rows) n = std::max(n, row.size());
    std::vector<Column> columns(n);
    for (std::size_t i = 0; i < n; ++i) {
        std::size_t longest = 0;
        for (const Lines& row : table.rows) longest = std::max(longest, width_of(cell_at(row, i)));
        columns[i].is_number =
            i > 0 && std::ranges::all_of(table.rows, [i](const Lines& row) { return is_number(cell_at(row, i)); });
        const bool is_free = columns[i].is_number || i + 1 == n || n <= most_free_columns;
        columns[i].width = is_free ? longest : std::min(longest, widest_words);
        columns[i].width = std::max(columns[i].width, std::min(narrowest_header, width_of(cell_at(table.header, i))));
        const auto hold_words = [&](const Lines& row) {
            for (const std::string& word : wrapped(cell_at(row, i), 1))
                columns[i].width = std::max(columns[i].width, width_of(word));
        };
        hold_words(table.header);
        std::ranges::for_each(table.rows, hold_words);
    }
    return columns;
}

// Cells of more than one line end in the same one.
std::string row_text(const Lines& row, const std::vector<Column>& columns) {
    std::vector<Lines> cells;
    std::size_t height = 1;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        cells.push_back(wrapped(cell_at(row, i), columns[i].width));
        height = std::max(height, cells.back().size());
    }
    std::string text;
    for (std::size_t k = 0; k < height; ++k) {
        std::string line;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const std::size_t above = height - cells[i].size();
            const std::string part = k < above ? "" : cells[i][k - above];
            const std::string blanks(columns[i].width - std::min(columns[i].width, width_of(part)), ' ');
            line += (i == 0 ? "" : "  ") + (columns[i].is_number ? blanks + part : part + blanks);
        }
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

}  // namespace

std::string text(const Table& table) {
    const std::vector<Column> columns = columns_of(table);
    std::string out = table.header.empty() ? "" : row_text(table.header, columns);
    for (const Lines& row : table.rows) out += row_text(row, columns);
    return out + "\n" + flowed(table.caption);
}

std::string text(const Page& page) {
    std::string out = flowed(page.verdict);
    for (const Section& section : page.sections) {
        if (section.is_of_page) continue;
        out += fmt::format("\n{}\n{:-<{}}\n", section.heading, "", width_of(section.heading));
        for (const std::string& words : section.paragraphs) out += flowed(words);
        for (const Table& table : section.tables) out += "\n" + text(table);
        if (!section.code.empty()) out += "\n" + section.code;
    }
    return out;
}

}  // namespace zlg::report
