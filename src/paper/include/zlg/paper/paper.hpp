#pragma once
// The whole paper recomputed: every figure and table, in its order, beside what is printed.

#include <string>
#include <vector>

#include <zlg/paper/paper_item.hpp>
#include <zlg/report/page.hpp>

namespace zlg::paper {

struct Paper {
    config::Config config;  // of the gyro
    std::vector<PaperItem> items;
    std::vector<Claim> claims;
    double chi2_per_dof = 0.0;  // of all points measured on the twin, against theory
    int degrees_of_freedom = 0;
};

[[nodiscard]] const char* verdict_name(Verdict verdict);

// How many claims got each verdict, as text.
[[nodiscard]] std::string verdict_counts(const std::vector<Claim>& claims);

// errors  config::ConfigError, design::DesignError; logs::IoError, logs::FormatError for a motion file.
// cost    about a minute of one processor, with 2000 switches per point.
[[nodiscard]] Paper recompute_paper(const PaperTask& task);

[[nodiscard]] report::Page paper_page(const Paper& paper);

}  // namespace zlg::paper
