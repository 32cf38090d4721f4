#pragma once
// What a part of the recomputed paper shows.

#include <zlg/report/figure.hpp>
#include <zlg/report/page.hpp>

#include "test.hpp"

namespace zlg::test {

inline const report::Series* series(const report::Figure& figure, const std::string& name) {
    for (const auto& s : figure.series)
        if (s.name == name) return &s;
    return nullptr;
}

inline std::string text_of(const report::Section& section) {
    std::string all;
    for (const auto& p : section.paragraphs) all += p + "\n";
    return all;
}

inline bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace zlg::test
