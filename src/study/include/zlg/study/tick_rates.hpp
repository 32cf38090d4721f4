#pragma once
// The ticks of a log of zlg as one axis of an analysis: angles as rates, and their error where the truth is known.

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <zlg/core/records.hpp>
#include <zlg/logs/angle_log.hpp>
#include <zlg/study/axis.hpp>

namespace zlg::study {

class TickRates {
public:
    // name  of the file without its folder.
    TickRates(std::string name, const std::string& path, double tick_s);

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

}  // namespace zlg::study
