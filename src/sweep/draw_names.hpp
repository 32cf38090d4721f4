#pragma once
// The names of the draws in a description, in the order of DrawKind.

#include <array>
#include <string_view>

#include <zlg/sweep/description.hpp>

namespace zlg::sweep {

inline constexpr std::array<std::string_view, 8> draw_names{"grid",   "list",      "uniform", "log_uniform",
                                                            "normal", "truncated", "latin",   "sobol"};

[[nodiscard]] constexpr std::string_view name_of(DrawKind kind) { return draw_names[static_cast<std::size_t>(kind)]; }

// Which numbers a draw is described by.
[[nodiscard]] constexpr bool has_values(DrawKind kind) { return kind == DrawKind::grid || kind == DrawKind::list; }
[[nodiscard]] constexpr bool has_mean(DrawKind kind) { return kind == DrawKind::normal || kind == DrawKind::truncated; }
[[nodiscard]] constexpr bool has_range(DrawKind kind) { return !has_values(kind) && kind != DrawKind::normal; }

}  // namespace zlg::sweep
