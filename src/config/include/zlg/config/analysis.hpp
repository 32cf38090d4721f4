#pragma once
// What `zlg analyze` is to compute.

#include <optional>
#include <string>
#include <vector>

namespace zlg::config {

enum class Deviation { adev, oadev, mdev, tdev, hdev, ohdev, totdev, mtotdev, htotdev };
enum class TotalBias { removed, published, as_computed };
enum class Taus { octave, decade, log, all };
enum class ShownRate { deg_h, arcsec_s, deg_s, rad_s };
enum class AngleColumn { final, delivered };
enum class TextSeparator { automatic, space, tab, semicolon, comma, bar };
enum class DecimalMark { automatic, point, comma };

struct Analysis {
    std::vector<Deviation> deviations = {Deviation::oadev};
    Taus taus = Taus::octave;
    int taus_per_decade = 20;
    std::vector<double> taus_s;  // instead of them
    double confidence = 0.95;
    double least_known_ratio = 0.9;
    TotalBias total_bias = TotalBias::removed;  // of totdev, mtotdev, htotdev
    ShownRate unit = ShownRate::deg_h;
    AngleColumn angles = AngleColumn::final;
    std::optional<double> latitude_deg;
    double table_settling_s = 0.0;  // of each stage
    double table_same_rate_ratio = 1e-4;
    double table_earth_arcsec_s = 0.0;
};

}  // namespace zlg::config
