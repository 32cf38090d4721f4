#pragma once
// The head of a table in Markdown.

#include <initializer_list>
#include <string>
#include <string_view>

namespace zlg::trials {

inline std::string table_head(std::initializer_list<std::string_view> columns) {
    std::string names = "|";
    std::string rule = "|";
    for (const std::string_view column : columns) {
        names += " " + std::string{column} + " |";
        rule += "---|";
    }
    return names + "\n" + rule + "\n";
}

}  // namespace zlg::trials
