#pragma once
// What was read as axes of an analysis: the ticks of a log of zlg, as rates, and the axes of another program's file.

#include <limits>
#include <string>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/imported.hpp>
#include <zlg/study/axis.hpp>

namespace zlg::study {

class TickRates {
public:
    TickRates(const std::string& path, double tick_s);

    // A tick that was bridged, or not even that, is none of the rates.
    void take(const core::AngleRow& row, double truth_arcsec = std::numeric_limits<double>::quiet_NaN());

    // The angle, with warnings of values that may be no measurements, then its error where every tick has its truth.
    void finish(std::vector<AxisRecord>& axes);

    [[nodiscard]] bool empty() const { return axis_.rates_arcsec_s.empty(); }

private:
    AxisRecord axis_;
    std::vector<double> truth_;
    double tick_s_;
};

// The times of the rows of an angle log must bear out the length of a tick.
//
// errors  logs::FormatError.
void check_tick(const std::string& path, double tick_s, double first_s, const logs::TimedAngle& last);

// Named by the file without its folder, and by its column.
[[nodiscard]] AxisRecord axis_of(const std::string& path, logs::ImportedAxis&& from);

}  // namespace zlg::study
