#include <zlg/deviations/deviation_kind.hpp>

#include <string>

#include <fmt/format.h>
#include <zlg/deviations/series.hpp>

namespace zlg::deviations {
namespace {

constexpr std::array<std::string_view, 7> names{"adev", "oadev", "mdev", "tdev", "hdev", "ohdev", "totdev"};

}  // namespace

std::string_view name_of(DeviationKind kind) { return names.at(static_cast<std::size_t>(kind)); }

DeviationKind deviation_kind_of(std::string_view name) {
    for (std::size_t k = 0; k < names.size(); ++k)
        if (names[k] == name) return static_cast<DeviationKind>(k);
    std::string allowed;
    for (const auto& known : names) allowed += (allowed.empty() ? "" : ", ") + std::string(known);
    throw SeriesError(fmt::format("deviation: '{}' is unknown, allowed: {}", name, allowed));
}

bool is_modified(DeviationKind kind) { return kind == DeviationKind::mdev || kind == DeviationKind::tdev; }

bool is_side_by_side(DeviationKind kind) { return kind == DeviationKind::adev || kind == DeviationKind::hdev; }

int difference_order(DeviationKind kind) { return kind == DeviationKind::hdev || kind == DeviationKind::ohdev ? 3 : 2; }

}  // namespace zlg::deviations
