#pragma once
// What `zlg analyze` is to compute.

#include <optional>
#include <string>
#include <vector>

namespace zlg::config {

enum class Deviation { adev, oadev, mdev, tdev, hdev, ohdev, totdev, mtotdev, htotdev };
enum class Taus { octave, decade, all };
enum class ShownRate { deg_h, arcsec_s, deg_s, rad_s };
enum class TextSeparator { automatic, space, tab, semicolon, comma, bar };
enum class DecimalMark { automatic, point, comma };

struct Analysis {
    std::vector<Deviation> deviations = {Deviation::oadev};
    Taus taus = Taus::octave;
    std::vector<double> taus_s;  // instead of them
    double confidence = 0.95;
    ShownRate unit = ShownRate::deg_h;
    double table_settling_s = 0.0;  // of each stage
    double table_earth_arcsec_s = 0.0;
};

}  // namespace zlg::config
