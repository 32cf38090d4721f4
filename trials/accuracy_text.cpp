#include <cmath>

#include <fmt/format.h>

#include "accuracy_tables.hpp"

namespace zlg::trials {
namespace {

std::string row_text(const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += fmt::format(" {} |", cell);
    return text + "\n";
}

std::string table_text(const report::Table& table) {
    std::string text = row_text(table.header) + "|";
    for (std::size_t k = 0; k < table.header.size(); ++k) text += "---|";
    text += "\n";
    for (const auto& row : table.rows) text += row_text(row);
    return text;
}

}  // namespace

std::string markdown(const Accuracy& accuracy) {
    std::string text;
    for (const TableOfAccuracy& t : tables_of(accuracy))
        text += fmt::format("## {}\n\n{}\n\n{}\n", t.heading, t.words, table_text(t.table));
    return text;
}

}  // namespace zlg::trials
