#include "relock_view.hpp"

#include <algorithm>

namespace zlg::calibration {
namespace {

// The sum of counts of the settled ticks of each segment.
std::vector<double> settled_counts(const LabLog& log) {
    std::vector<double> counts(log.segments.size(), 0.0);
    for (const Block& block : log.blocks)
        counts[static_cast<std::size_t>(block.segment)] += static_cast<double>(block.counts);
    return counts;
}

void collect(const LabLog& log, std::vector<RelockView>& views) {
    if (!log.has_square()) return;
    const std::vector<double> counts = settled_counts(log);
    for (const Relock& relock : log.relocks) {
        const auto index = static_cast<std::size_t>(relock.segment);
        const Segment& segment = log.segments[index];
        if (!is_whole(relock, &core::HalfRecord::detuning_sq_lambda2) || segment.n_settled < block_ticks) continue;
        views.push_back({&log, &relock, counts[index] / static_cast<double>(2 * segment.n_settled)});
    }
}

bool has_phase(const Relock& relock) {
    return relock.before.is_known() &&
           std::ranges::all_of(relock.halves, [](const core::HalfRecord& r) { return core::border_of(r).is_known(); });
}

double excess(const RelockView& view, std::size_t half) {
    return view.relock->halves[half].detuning_sq_lambda2 - view.log->square.mean;
}

}  // namespace

Relocks::Relocks(std::span<const LabLog> logs) {
    for (const LabLog& log : logs) collect(log, views);
    if (views.empty()) return;
    const bool with_phase = std::ranges::all_of(views, [](const RelockView& view) { return has_phase(*view.relock); });
    for (RelockView& view : views) view.with_phase = with_phase;
    std::vector<double> mean(relock_halves, 0.0);
    for (const RelockView& view : views)
        for (std::size_t h = 0; h < mean.size(); ++h) mean[h] += excess(view, h) / static_cast<double>(views.size());
    first_square_lambda2 = mean[0];
    const double least = 0.01 * *std::max_element(mean.begin(), mean.end());
    while (transient_halves < relock_halves / 2 && mean[transient_halves] > least) ++transient_halves;
    transient_halves = std::max<std::size_t>(transient_halves, 4);
    // Below this the noise of a mean square would look like a fall.
    for (std::size_t h = 0; h < transient_halves; ++h)
        if (mean[h] > 4.0 * least) steepest_fall = std::min(steepest_fall, std::max(0.0, mean[h + 1] / mean[h]));
}

bool Relocks::has_detunings() const {
    return std::ranges::all_of(views, [](const RelockView& view) {
        return std::ranges::all_of(view.relock->halves,
                                   [](const core::HalfRecord& r) { return std::abs(r.detuning_lambda) < 1e3; });
    });
}

}  // namespace zlg::calibration
