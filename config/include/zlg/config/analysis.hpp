#pragma once
// What `zlg analyze` is to compute, and what the columns of a text file hold.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace zlg::config {

enum class Deviation { adev, oadev, mdev, tdev, hdev, ohdev, totdev, mtotdev, htotdev };
enum class Taus { octave, decade, log, all };
enum class ShownRate { deg_h, arcsec_s, deg_s, rad_s };
enum class AngleColumn { final, delivered };
enum class TextHolds { increment, rate, phase };

struct Analysis {
    std::vector<Deviation> deviations = {Deviation::oadev};
    Taus taus = Taus::octave;
    std::int64_t taus_per_decade = 20;
    std::vector<double> taus_s;  // instead of them
    double confidence = 0.95;
    double least_known_ratio = 0.9;
    ShownRate unit = ShownRate::deg_h;
    AngleColumn angles = AngleColumn::final;
    std::optional<double> latitude_deg;
    std::vector<double> column;             // of a text file; first is 1; none: 1
    std::optional<TextHolds> column_holds;  // unset: the file is described by [motion]
    double scale_arcsec = 1.0;
    std::optional<double> rate_hz;
    std::string comment = "#";
    std::int64_t skip_lines = 0;
    std::int64_t table_column = 0;      // of a rate table's rate; 0: no such test
    double table_scale_arcsec_s = 1.0;  // arcsec/s per unit of it
    double table_settling_s = 0.0;      // of each stage
    double table_same_rate_ratio = 1e-4;
    double table_earth_arcsec_s = 0.0;
};

}  // namespace zlg::config
