#pragma once
// The parts of the recomputed paper, one function per figure or table.

#include <zlg/paper/paper_item.hpp>
#include <zlg/study/run.hpp>

namespace zlg::paper {

// Drift: figures 3 (from a run of the twin), 4 and 5.
[[nodiscard]] PaperItem paper_figure_3(const PaperTask& task, const study::RunResult& run);
[[nodiscard]] PaperItem paper_figure_4(const PaperTask& task);
[[nodiscard]] PaperItem paper_figure_5(const PaperTask& task);

// False drift after re-lock: tables 1 and 2, with what the twin gives.
[[nodiscard]] PaperItem paper_table_1(const PaperTask& task, const study::RunResult& run);
[[nodiscard]] PaperItem paper_table_2(const PaperTask& task, const study::RunResult& run);

// All checked claims of the paper, in its order.
[[nodiscard]] std::vector<Claim> paper_claims(const PaperTask& task);

// Diagrams from the program's own signals and structure: figures 1, 2 and 7.
[[nodiscard]] PaperItem paper_figure_1(const PaperTask& task);
[[nodiscard]] PaperItem paper_figure_2();
[[nodiscard]] PaperItem paper_figure_7(const PaperTask& task);

// Substitution: figure 6 (from a run of the twin), and 8a, 8b, 9a-c, 10a-c, 11 with points measured on the twin.
[[nodiscard]] PaperItem paper_figure_6(const study::RunResult& run);

struct SubstitutionFigures {
    std::vector<PaperItem> items;
    double chi2_per_dof = 0.0;
    int degrees_of_freedom = 0;
};
[[nodiscard]] SubstitutionFigures paper_figures_8_to_11(const PaperTask& task);

}  // namespace zlg::paper
