#pragma once
// The tables of a campaign, the same for the page and for the terminal.

#include <string>
#include <vector>

#include <zlg/report/page.hpp>
#include <zlg/trials/accuracy.hpp>

namespace zlg::trials {

struct TableOfAccuracy {
    std::string heading;
    std::string words;
    report::Table table;
};

[[nodiscard]] std::vector<TableOfAccuracy> tables_of(const Accuracy& accuracy);

// Every method in every case, for the page.
[[nodiscard]] std::vector<TableOfAccuracy> detailed_tables_of(const Accuracy& accuracy);

}  // namespace zlg::trials
