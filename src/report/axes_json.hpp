#pragma once
// What the script of a page knows of a figure.

#include <string>

#include <zlg/report/figure.hpp>

namespace zlg::report {

// {"x":[lo,hi,log,label],"y":[...],"series":[{"name","drawn"}]}: limits as the axes are drawn, of a log axis in
// decades.
[[nodiscard]] std::string axes_json(const Figure& figure);

}  // namespace zlg::report
