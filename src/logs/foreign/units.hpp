#pragma once
// Units of angles and rates, as people write them.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zlg::logs {

enum class UnitKind { rate, angle };

struct AngleUnit {
    std::string_view name;
    UnitKind kind = UnitKind::angle;
    double arcsec = 0.0;     // of one, or arcsec/s
    bool of_counts = false;  // times what a count is worth
};

// deg/s, dps, rad_s, arcsec and the like, in any case but that of M, mega; empty where it is none.
[[nodiscard]] std::optional<AngleUnit> unit_named(std::string_view word);

// The unit in the name of a column: in brackets, or behind the last underscores. Empty where a factor stands beside it.
[[nodiscard]] std::optional<AngleUnit> unit_in_name(std::string_view column_name);

// The name has the unit of a rate, with a factor or without one.
[[nodiscard]] bool names_rate(std::string_view column_name);

[[nodiscard]] std::string allowed_units();

}  // namespace zlg::logs
