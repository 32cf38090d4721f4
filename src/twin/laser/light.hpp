#pragma once

namespace zlg::twin {

inline constexpr double light_m_s = 299792458.0;
inline constexpr double wavelength_m = 632.8e-9;

}  // namespace zlg::twin
