#pragma once
// A constant as far as data determine it.

#include <string>
#include <utility>

namespace zlg::numeric {

struct Estimate {
    bool determined = false;
    double value = 0.0;
    double sigma = 0.0;  // one standard deviation
    std::string reason;  // why not determined
};

[[nodiscard]] inline Estimate refused(std::string reason) { return {.reason = std::move(reason)}; }

// A number that is not finite, or whose sigma is none, determines nothing.
[[nodiscard]] Estimate estimated(double value, double sigma);

// A standard deviation that was itself found from the scatter with so many degrees of freedom, as that of the value:
// Student's t is wider than the normal law.
//
//   sigma sqrt(dof/(dof - 2))
//
// return  infinite for dof <= 2.
[[nodiscard]] double widened(double sigma, double dof);

}  // namespace zlg::numeric
