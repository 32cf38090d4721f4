#pragma once
// What figures and diagrams have in common as SVG.

#include <string>

#include "layout.hpp"

namespace zlg::report {

// The opening tag of a drawing as wide as the page gives it, and what it says to those who cannot see it.
[[nodiscard]] std::string opening(const std::string& id, double height, const std::string& title,
                                  const std::string& described);

[[nodiscard]] std::string text_at(const Line& line, const char* anchor);

}  // namespace zlg::report
