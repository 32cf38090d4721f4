#include "counter_rounding.hpp"

#include <zlg/core/common/maths.hpp>

namespace zlg::core {
namespace {

constexpr double two_pi_squared = 19.739208802178716;
constexpr double max_scatter_counts2 = 2.0;

// Distance to the nearest whole number. The law is even in it.
double distance_to_whole(double x) noexcept {
    constexpr double most = 2e15;
    constexpr double whole_part = 6755399441055744.0;  // 1.5 2^52: a sum with it is whole
    if (!(x < most && x > -most)) return 0.0;
    const double off = x - ((x + whole_part) - whole_part);
    return off < 0.0 ? -off : off;
}

}  // namespace

double rounding_law(double turn_counts, double scatter_counts2) noexcept {
    if (!(scatter_counts2 < max_scatter_counts2)) return 0.0;
    const double x = distance_to_whole(turn_counts);
    const double coherence = scatter_counts2 > 0.0 ? maths::exp(-two_pi_squared * scatter_counts2) : 1.0;
    return 0.5 * (x * x - x + 1.0 / 6.0) * coherence;
}

}  // namespace zlg::core
