#pragma once
// What an acceptance test can say of a gyro: the names, units and definitions, and a value with what is known of its
// error.

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <zlg/acceptance/plan.hpp>

namespace zlg::acceptance {

struct QuantityInfo {
    std::string_view name;  // "bias.deg_h"
    std::string_view words;
    std::string_view unit;   // as people write it
    std::string_view needs;  // the log from which it follows
    std::vector<RunKind> kinds;
};

[[nodiscard]] std::span<const QuantityInfo> quantities();
// nullptr: there is none.
[[nodiscard]] const QuantityInfo* find_quantity(std::string_view name);
// Never below 0: a deviation, a time, a number.
[[nodiscard]] bool is_magnitude(std::string_view name);
// Of a name that is none: the nearest one, and the unit where only that is wrong.
[[nodiscard]] std::string unknown_quantity(std::string_view name);

// How the estimate scatters about the truth.
enum class Law {
    student,       // value + uncertainty t, t of Student's law
    chi,           // a standard deviation: degrees value^2/truth^2 of the chi-square law
    poisson,       // events in `hours`, divided by them
    without_error  // counted, or read
};

// What a record L times as long does.
enum class Longer {
    adds_degrees,   // uncertainty/sqrt(L), L times the degrees
    keeps_degrees,  // uncertainty/sqrt(L), the degrees are those of what noise it may be
    helps_not       // slow noise is more probable than none
};

struct Value {
    std::string name;
    bool determined = false;
    double value = std::numeric_limits<double>::quiet_NaN();
    double uncertainty = std::numeric_limits<double>::quiet_NaN();  // one standard deviation
    double degrees = std::numeric_limits<double>::infinity();       // of freedom of that uncertainty
    Law law = Law::student;
    double hours = 0.0;  // of the record from which it comes
    std::string reason;  // why it is not determined, or what the value is
    Longer longer = Longer::adds_degrees;
    double moves = 1.0;  // part of the uncertainty by which a much longer record moves the value, a standard deviation
};

[[nodiscard]] Value not_determined(std::string_view name, std::string reason);
// What was counted or read, without an error.
[[nodiscard]] Value counted(std::string_view name, double value, double hours);
// By the law of Student.
[[nodiscard]] Value measured(std::string_view name, double value, double uncertainty, double degrees, double hours);
// A standard deviation, by the law of chi-square.
[[nodiscard]] Value deviation(std::string_view name, double value, double degrees, double hours);

}  // namespace zlg::acceptance
