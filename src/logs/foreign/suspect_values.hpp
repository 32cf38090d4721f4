#pragma once
// Values that are numbers and measure nothing.

#include <string>
#include <vector>

#include <zlg/logs/imported.hpp>
#include <zlg/logs/text_columns.hpp>

#include "units.hpp"

namespace zlg::logs {

// errors  FormatError: an angle that begins anew after a circle, or a register that overflows.
void refuse_wraps(const ForeignLook& look, const TextColumn& column, const AngleUnit& unit);

// What the mapping calls missing becomes NaN, but for times.
void take_out_missing(const Mapping& mapping, TextTable& read);

// errors  FormatError: a value such as -9999, far from all others.
void refuse_missing_marks(const std::string& path, const TextColumn& column);

// Values that may be no measurements, a line each: rows that repeat the row before, long stretches of one value, values
// at a rail. `holds`: as the mapping says.
[[nodiscard]] std::vector<std::string> no_measurements(const TextColumn& column, const std::string& holds);

}  // namespace zlg::logs
