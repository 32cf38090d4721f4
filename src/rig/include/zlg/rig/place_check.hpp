#pragma once
// Whether the places within the count, column `fringe` of a recorded log, belong to its counts.
//
// Borders of halves, two halves apart, have the angle S + p: the sum S of the counts and the place p, both in counts.
// The difference of the eighth order over nine of them removes a motion of up to a tenth of the rate of the ticks, and
// the bias; of a place that is spread evenly over its count it has the variance C(16, 8)/12, here the unit. So with
//
//   y = D8 S,  q = D8 p,  x = y + q:   right places  <y^2 - x^2> = <q^2>, for x is the motion, which knows nothing of p
//                                      others        <y^2 - x^2> = -<q^2>, for y knows nothing of q
//
// whatever the motion; its part of y, where it is rougher than two units, makes the mean uncertain, and nothing is
// decided. Where the angle has been evenly in all parts of a count, x knows nothing of a right place at all, <x q> = 0:
// half a place, a random one in ten or a periodic error show there. Places that stand still while the counts move show
// y without q. Squares are limited, so that a single jerk decides nothing.

#include <array>
#include <cstdint>
#include <string>

#include <zlg/core/records.hpp>

namespace zlg::rig {

class PlaceCheck {
public:
    void take(const core::HalfRecord& half);

    // One line where places contradict the counts in a stretch of 4096 differences, a last one of 512 or more among
    // them; empty where none does, and where nothing can be decided.
    [[nodiscard]] std::string complaint(const std::string& log_name) const;

private:
    static constexpr int n_borders = 17;

    struct Stretch {
        int n = 0;
        int n_rough = 0;                                     // y beyond 3
        int n_counts = 0;                                    // y beyond 1/2
        double y_sq = 0.0;                                   // sum of y^2, each up to 9
        double q_sq = 0.0;                                   // sum of q^2, each up to 9
        double agree = 0.0;                                  // sum of y^2 - x^2, each within +-9
        double motion_sq = 0.0, place_sq = 0.0, both = 0.0;  // sums of x^2, q^2, x q without limits
        std::array<int, 8> n_in_part{};  // differences whose mean angle lies in each eighth of a count
        std::uint32_t bits = 0;          // that were set in any place
    };
    enum class Verdict : unsigned char { open, right, wrong };

    struct BorderPlace {
        std::uint64_t counts = 0;  // sum, wraps
        double place = 0.0;        // 0..1
    };

    static bool is_even(const Stretch& s);
    static Verdict verdict(const Stretch& s);
    void add_difference();

    std::array<BorderPlace, n_borders> borders_{};
    int n_known_ = 0;  // the last borders in a row, up to n_borders, between halves that were measured
    std::size_t last_ = 0;
    Stretch stretch_{};
    std::int64_t half_ = 0;
    std::int64_t n_stretches_ = 0;
    std::int64_t n_wrong_ = 0;
    std::int64_t first_wrong_half_ = 0;
};

}  // namespace zlg::rig
