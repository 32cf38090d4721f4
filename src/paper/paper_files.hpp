#pragma once
// What of the recomputed paper never changes, which the build makes texts of: its words and its drawings.

namespace zlg::paper {

extern const char* const claims_md;
extern const char* const figures_md;
extern const char* const figure_1_svg;
extern const char* const figure_2_svg;

}  // namespace zlg::paper
