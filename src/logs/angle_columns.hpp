#pragma once
// The columns of an angle log.

#include <array>
#include <string>
#include <zlg/logs/angle_layout.hpp>

#include "column_map.hpp"

namespace zlg::logs::angles {

enum : std::size_t { tick, t_s, dtheta_arcsec, dtheta_final_arcsec, sigma_arcsec, mode, flags };

inline constexpr std::array<Column, 7> columns{{{"tick"},
                                                {"t_s", true, "s"},
                                                {"dtheta_arcsec", true, "arcsec"},
                                                {"dtheta_final_arcsec", true, "arcsec"},
                                                {"sigma_arcsec", true, "arcsec"},
                                                {"mode"},
                                                {"flags"}}};

// What the twin turned in each tick, in an HDF5 log.
inline constexpr const char* truth_group = "/truth";
inline constexpr const char* truth_name = "dtheta_arcsec";
inline constexpr const char* truth_path = "/truth/dtheta_arcsec";

// `switching:1 extrapolated:2 ...`
[[nodiscard]] std::string flag_legend();

// What both formats refuse to write. errors  FormatError.
void require_loggable(const TimedAngle& angle);

}  // namespace zlg::logs::angles
