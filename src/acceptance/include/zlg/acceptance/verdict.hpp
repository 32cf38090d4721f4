#pragma once
// Whether a value is within its limits, as far as chance lets one know.
//
// p is the probability that the truth lies beyond a limit, given the value, its uncertainty and the degrees of freedom
// of that (no prior: the fiducial law, of which the one-sided bounds are those of classical statistics). With the risk
// r
//
//   pass       p(beyond min) + p(beyond max) <= r
//   fail       p(within) <= r
//   undecided  neither
//
// For a Student law that is a guard band of t_(1-r) u inside each limit, as decision rules of JCGM 106:2012 (8.3.2)
// have it; of a standard deviation p is that of the chi-square law, of a number of events that of Poisson's.

#include <optional>
#include <string>

#include <zlg/acceptance/quantity.hpp>

namespace zlg::acceptance {

enum class Verdict { pass, fail, undecided, not_determined };

[[nodiscard]] std::string_view name_of(Verdict verdict);

// That the truth is larger than x.
[[nodiscard]] double probability_above(const Value& value, double x);

struct Judged {
    Value value;
    std::optional<Limit> limit;
    std::optional<Verdict> verdict;  // of a value that is determined only where there is a limit
    double risk = 0.0;               // that the truth lies beyond the limit, of what passes
    // By which the record would be longer when it decides with an even chance; absent where no time does.
    std::optional<double> more_hours;
};

// risk  0 < . < 0.5.
[[nodiscard]] Judged judge(const Value& value, const std::optional<Limit>& limit, double risk);

// That a unit which passes by all of these lies beyond at least one limit: 1 - product of (1 - risk), and so at most
// their sum.
[[nodiscard]] double unit_risk(const std::vector<Judged>& all);

}  // namespace zlg::acceptance
