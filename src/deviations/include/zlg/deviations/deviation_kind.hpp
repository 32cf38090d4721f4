#pragma once
// The deviations by name.

#include <array>
#include <string_view>

namespace zlg::deviations {

// Two-sample deviations of the rate averaged over tau, all of which give white rate noise the value sigma/sqrt(tau):
//
//   adev, oadev      second differences of the angle at distance tau; side by side, or from every sample
//   mdev, tdev       second differences of the angle averaged over tau, and the same times tau/sqrt(3): an angle
//   hdev, ohdev      third differences: a constant drift of the rate drops out
//   totdev           oadev with the record mirrored at both ends (angle: doubly reflected)
enum class DeviationKind { adev, oadev, mdev, tdev, hdev, ohdev, totdev };

inline constexpr std::array deviation_kinds{DeviationKind::adev,  DeviationKind::oadev, DeviationKind::mdev,
                                            DeviationKind::tdev,  DeviationKind::hdev,  DeviationKind::ohdev,
                                            DeviationKind::totdev};

[[nodiscard]] std::string_view name_of(DeviationKind kind);

// errors  SeriesError: another name.
[[nodiscard]] DeviationKind deviation_kind_of(std::string_view name);

// Of the angle averaged over tau: mdev, tdev.
[[nodiscard]] bool is_modified(DeviationKind kind);

// Of differences that begin every tau, and not at every sample: adev, hdev.
[[nodiscard]] bool is_side_by_side(DeviationKind kind);

// Order of the differences of the angle: 2, or 3 for the Hadamard deviations.
[[nodiscard]] int difference_order(DeviationKind kind);

}  // namespace zlg::deviations
