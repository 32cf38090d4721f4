#pragma once
// Round marks of an axis.

#include <string>
#include <vector>

#include "scale.hpp"

namespace zlg::report {

inline constexpr double tick_font_size = 16.0;

struct Tick {
    double at = 0.0;  // place on the page
    std::string label;
};

struct Ticks {
    std::vector<Tick> major;
    std::vector<double> minor;  // places of the fine grid
};

enum class Side { bottom, left };

// Marks 1, 2 or 5 times a power of ten apart; on a log axis decades with their fine grid, or 1-2-5 where there are few.
// As many as the labels leave room for.
[[nodiscard]] Ticks ticks_of(const Scale& scale, Side side);

}  // namespace zlg::report
