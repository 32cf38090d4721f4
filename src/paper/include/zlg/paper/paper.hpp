#pragma once
// The whole paper recomputed: every figure and table, in its order, beside what is printed.

#include <functional>
#include <string>
#include <vector>

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

[[nodiscard]] const char* verdict_name(Verdict verdict);

// Something that the paper says, and what became of it.
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

struct Paper {
    std::vector<PaperItem> items;
    std::vector<Claim> claims;
    double chi2_per_dof = 0.0;  // of all points measured on the twin, against theory
    int degrees_of_freedom = 0;
};

// How many claims got each verdict, as text.
[[nodiscard]] std::string verdict_counts(const std::vector<Claim>& claims);

// errors  config::ConfigError, design::DesignError; logs::IoError, logs::FormatError for a motion file.
// cost    about a minute of one processor, with 2000 switches per point.
[[nodiscard]] Paper recompute_paper(const PaperTask& task);

[[nodiscard]] report::Page paper_page(const Paper& paper);

}  // namespace zlg::paper
