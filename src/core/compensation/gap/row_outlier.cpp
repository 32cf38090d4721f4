#include "row_outlier.hpp"

#include <array>

#include <zlg/core/common/maths.hpp>

#include "common/bounds.hpp"

namespace zlg::core {
namespace {

// Ticks on one side of the one that is judged: the two nearest that were measured.
struct Side {
    int n = 0;
    double value_arcsec = 0.0;      // their mean
    double place = 0.0;             // mean of their distances, ticks
    double variance_arcsec2 = 0.0;  // the larger one
};

// Above so many times the variance of the row that is judged, a neighbour tells nothing of it.
constexpr double comparable = 9.0;

bool is_comparable(const HistoryTick& entry, double variance_arcsec2) noexcept {
    return entry.measured && entry.row.sigma_arcsec * entry.row.sigma_arcsec <= comparable * variance_arcsec2;
}

Side neighbours(const GapBridgeState& state, std::int64_t tick, int way, std::int64_t n_ticks,
                double variance_arcsec2) noexcept {
    Side side;
    for (std::int64_t k = 1; k <= n_ticks && k <= max_gap_ticks && side.n < 2; ++k) {
        const HistoryTick& entry = at(state, tick + way * k);
        if (!is_comparable(entry, variance_arcsec2)) continue;
        const double variance = entry.row.sigma_arcsec * entry.row.sigma_arcsec;
        ++side.n;
        const double n = side.n;
        side.value_arcsec += (entry.row.dtheta_final_arcsec - side.value_arcsec) / n;
        side.place += (static_cast<double>(k) - side.place) / n;
        if (variance > side.variance_arcsec2) side.variance_arcsec2 = variance;
    }
    return side;
}

// What is expected between both sides, or beside the only one.
double expected_arcsec(const Side& before, const Side& after) noexcept {
    if (before.n == 0) return after.value_arcsec;
    if (after.n == 0) return before.value_arcsec;
    const double slope = (after.value_arcsec - before.value_arcsec) / (after.place + before.place);
    return before.value_arcsec + slope * before.place;
}

// Beside a gap or a tick of little worth, or at an end of the log.
[[gnu::noinline]] double gained_beside_gap(GapBridgeState& state, std::int64_t to_come, const AngleRow& row,
                                           double variance_arcsec2) noexcept {
    const Side before = neighbours(state, row.tick, -1, row.tick, variance_arcsec2);
    const Side after = neighbours(state, row.tick, 1, to_come, variance_arcsec2);
    if (before.n + after.n == 0) return 0.0;
    double variance = variance_arcsec2;
    if (before.variance_arcsec2 > variance) variance = before.variance_arcsec2;
    if (after.variance_arcsec2 > variance) variance = after.variance_arcsec2;
    return step(state.outlier, row.dtheta_final_arcsec - expected_arcsec(before, after), variance, false);
}

// Over the variance of a tick; that of whole counts is a sixth of the square of a count.
constexpr double glance = 6.0;

// One tick in four is learnt, by a sequence without a period.
bool is_drawn(std::int64_t tick) noexcept { return (static_cast<std::uint32_t>(tick) * 0x9e3779b9u) >> 30 == 0; }

double gained_arcsec2(const CompensationConstants& gyro, GapBridgeState& state, std::int64_t to_come,
                      const AngleRow& row) noexcept {
    const std::int64_t tick = row.tick;
    const HistoryTick& before = at(state, tick - 1);
    const HistoryTick& after = at(state, tick + 1);
    const bool drawn = is_drawn(tick);
    const bool inside = to_come >= 2 && before.measured && after.measured;
    const double beside = before.row.dtheta_final_arcsec + after.row.dtheta_final_arcsec;
    const double off = row.dtheta_final_arcsec - 0.5 * beside;
    double variance = row.sigma_arcsec * row.sigma_arcsec;
    const double least = rounding_arcsec2(gyro, state.learning.moments.with_phase);
    if (variance < least) variance = least;
    // Of whole counts it is then within a count of those two, and within 1.5 counts of all four.
    if (inside && !drawn && off * off <= glance * variance) return 0.0;
    if (!is_finite(variance)) return 0.0;
    const HistoryTick& first = at(state, tick - 2);
    const HistoryTick& last = at(state, tick + 2);
    double largest = variance;
    bool all = inside;
    for (const HistoryTick* const near : std::array{&first, &before, &after, &last}) {
        all = all && is_comparable(*near, variance);
        const double of_near = near->row.sigma_arcsec * near->row.sigma_arcsec;
        if (of_near > largest) largest = of_near;
    }
    if (!all) return gained_beside_gap(state, to_come, row, variance);
    const double others = first.row.dtheta_final_arcsec + beside + last.row.dtheta_final_arcsec;
    return step(state.outlier, row.dtheta_final_arcsec - 0.25 * others, largest, drawn);
}

}  // namespace

void hold_apart(const CompensationConstants& gyro, GapBridgeState& state, std::int64_t to_come,
                AngleRow& row) noexcept {
    if (!at(state, row.tick).measured) return;
    const double gained = gained_arcsec2(gyro, state, to_come, row);
    if (gained > 0.0) row.sigma_arcsec = square_root(row.sigma_arcsec * row.sigma_arcsec + gained);
}

}  // namespace zlg::core
