#include "stream_level.hpp"

#include <algorithm>
#include <bit>

#include "sums/difference_sums.hpp"

namespace zlg::deviations {
namespace {

constexpr std::int64_t kept_windows = 3;  // a term spans up to three
constexpr std::int64_t means_a_run = 256;
constexpr std::uint64_t runs_before_thinning = 16;

RecordView view_of(const RecentEntries& entries, std::int64_t stride, const StreamGaps& gaps) {
    return {.angle = entries.angle(),
            .known_real = gaps.any && !gaps.is_phase ? entries.known() : nullptr,
            .may_be_missing = gaps.any && gaps.is_phase,
            .n_intervals = entries.n() - 1,
            .least_known_ratio = gaps.least_known_ratio,
            .stride = stride};
}

// Terms of the starts that are complete, from track.next on.
void take(Track& track, const RecentEntries& entries, const RecordView& view) {
    const int order = difference_order(track.kind);
    const bool averaged = is_modified(track.kind);
    const std::int64_t end = view.n_intervals + 1 - (averaged ? 3 * track.m - 1 : order * track.m);
    const std::int64_t begin = track.next - entries.first();
    if (end <= begin) return;
    if (averaged)
        track.sum.add(averaged_sum(view, track.m, begin, end));
    else
        for (std::int64_t at = begin; at < end; at += block_starts)
            track.sum.add(difference_sum(view, order, track.m, at, std::min(at + block_starts, end)));
    track.next = entries.first() + end;
}

bool is_used(std::int64_t run) {
    const std::uint64_t distance = std::bit_floor(static_cast<std::uint64_t>(run) / runs_before_thinning);
    return distance == 0 || static_cast<std::uint64_t>(run) % distance == 0;
}

void take(NoiseTrack& track, const RecentEntries& entries, const RecordView& view) {
    const std::int64_t m = track.means.m();
    for (; track.next + m < entries.first() + entries.n(); track.next += m) {
        const std::int64_t mean = track.next / m;
        if (is_used(mean / means_a_run))
            track.means.add(view, track.next - entries.first());
        else if (mean % means_a_run == 0)
            track.means.interrupt();
    }
}

}  // namespace

RecentEntries::RecentEntries(std::int64_t capacity)
    : angle_(static_cast<std::size_t>(capacity)), known_(static_cast<std::size_t>(capacity)) {}

void RecentEntries::forget_to(std::int64_t kept) {
    const std::int64_t gone = n_ - kept;
    std::copy(angle_.begin() + gone, angle_.begin() + n_, angle_.begin());
    std::copy(known_.begin() + gone, known_.begin() + n_, known_.begin());
    first_ += gone;
    n_ = kept;
}

StreamLevel::StreamLevel(std::int64_t stride, std::int64_t window, bool has_averages)
    : stride_(stride),
      window_(window),
      has_averages_(has_averages),
      borders_((kept_windows + 1) * window),
      averages_(has_averages ? (kept_windows + 1) * window : 0) {}

void StreamLevel::add_factor(std::int64_t m, const std::vector<DeviationKind>& kinds) {
    for (const auto kind : kinds) tracks_.push_back({.kind = kind, .m = m});
}

void StreamLevel::take_all(const RecentEntries& entries, bool averages, const StreamGaps& gaps) {
    const auto view = view_of(entries, stride_, gaps);
    for (auto& track : tracks_)
        if (is_modified(track.kind) == averages) take(track, entries, view);
    if (averages) return;
    for (auto& track : noise_) take(track, entries, view);
}

void StreamLevel::push_border(double angle, double known, const StreamGaps& gaps) {
    borders_.push(angle, known);
    if (!borders_.is_full()) return;
    take_all(borders_, false, gaps);
    borders_.forget_to(kept_windows * window_);
}

void StreamLevel::push_average(double angle_sum, double known_sum, const StreamGaps& gaps) {
    if (!has_averages_) return;
    averages_.push(angle_sum, known_sum);
    if (!averages_.is_full()) return;
    take_all(averages_, true, gaps);
    averages_.forget_to(kept_windows * window_);
}

TermSum StreamLevel::sum_of(DeviationKind kind, std::int64_t m, const StreamGaps& gaps) const {
    for (auto track : tracks_) {
        if (track.kind != kind || track.m != m) continue;
        const auto& entries = is_modified(kind) ? averages_ : borders_;
        take(track, entries, view_of(entries, stride_, gaps));
        return track.sum;
    }
    return {};
}

void StreamLevel::append_steps(std::vector<NoiseStep>& steps, const StreamGaps& gaps) const {
    for (auto track : noise_) {
        take(track, borders_, view_of(borders_, stride_, gaps));
        const std::int64_t m = track.means.m() * stride_;
        if (const auto noise = track.means.exponent(m)) steps.push_back({m, track.means.count(), *noise});
    }
}

std::size_t StreamLevel::memory_bytes() const {
    return borders_.memory_bytes() + averages_.memory_bytes() + tracks_.capacity() * sizeof(Track) +
           noise_.capacity() * sizeof(NoiseTrack);
}

}  // namespace zlg::deviations
