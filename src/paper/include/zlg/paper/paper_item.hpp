#pragma once
// What the recomputed paper is made of: one figure, table or claim each.

#include <functional>
#include <string>

#include <zlg/config/config.hpp>
#include <zlg/report/page.hpp>

namespace zlg::paper {

// One figure or table of the paper.
struct PaperItem {
    std::string number;  // "figure 8a", "table 1"
    report::Section
        section;  // our curves, the printed formula where it differs, points measured on the twin; what agrees
};

enum class Verdict { agrees, misprint, wrong, not_supported };

// A statement of the paper, and the result of its check.
struct Claim {
    std::string where;  // equation, figure or section
    std::string claim;  // in our words
    Verdict verdict = Verdict::agrees;
    std::string finding;  // with the numbers that decide
};

struct PaperTask {
    config::Config config;  // the gyro; the paper's by default
    int threads = 1;
    int switches_per_point = 2000;            // of the experiments on the twin
    std::function<void(double)> on_progress;  // optional; 0..1
};

}  // namespace zlg::paper
