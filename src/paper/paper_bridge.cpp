#include "paper_bridge.hpp"

#include <iterator>

namespace zlg::paper {

SubstitutionFigures paper_figures_8_to_11(const PaperTask& task) {
    const BridgePoints points = measure_bridge(task);
    const ChiSquare agreement = agreement_of_all(points);
    SubstitutionFigures out{
        .items = paper_figure_8(points), .chi2_per_dof = agreement.per_dof, .degrees_of_freedom = agreement.dof};
    std::vector<PaperItem> more = paper_figures_9_and_10(points);
    out.items.insert(out.items.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    out.items.push_back(paper_figure_11(task, points));
    return out;
}

}  // namespace zlg::paper
