#pragma once
// What `zlg analyze` is to compute, and what the columns of a text file hold.

#include <optional>
#include <string>
#include <vector>

namespace zlg::config {

enum class Deviation { adev, oadev, mdev, tdev, hdev, ohdev, totdev, mtotdev, htotdev };
enum class Taus { octave, decade, all };
enum class ShownRate { deg_h, arcsec_s, deg_s, rad_s };
enum class TextHolds { increment, rate, phase };
enum class TextSeparator { automatic, space, tab, semicolon, comma, bar };
enum class DecimalMark { automatic, point, comma };

struct Analysis {
    std::vector<Deviation> deviations = {Deviation::oadev};
    Taus taus = Taus::octave;
    std::vector<double> taus_s;  // instead of them
    double confidence = 0.95;
    ShownRate unit = ShownRate::deg_h;
    std::vector<std::string> column;        // of a text file, by number from 1 or by name; none: 1
    std::optional<TextHolds> column_holds;  // unset: the file is described by [motion]
    double scale_arcsec = 1.0;
    std::optional<double> rate_hz;
    std::string comment = "#";
    int skip_lines = 0;
    TextSeparator separator = TextSeparator::automatic;
    DecimalMark decimal = DecimalMark::automatic;
    std::string time_column;            // number or name; empty: looked for; "0": there is none
    std::string table_column;           // of a rate table's rate; empty or "0": no such test
    double table_scale_arcsec_s = 1.0;  // arcsec/s per unit of it
    double table_settling_s = 0.0;      // of each stage
    double table_earth_arcsec_s = 0.0;
};

}  // namespace zlg::config
