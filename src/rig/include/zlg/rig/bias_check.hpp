#pragma once
// Whether the columns `mode` and `bias_sign` of a recorded log belong to its counts.
//
// The bias adds bias_sign * mode * f to the rate of counts. Between two measured halves of one mode and opposite signs
//
//   b = bias_sign * mode * (n_h - n_(h-1))/2
//
// is the bias in a half and half the change of the rotation from one to the other. Where the columns are wrong it is as
// large, and negative. A single half proves nothing: a fault or a jerk may do that. Halves in a row do.
//
// A counter that drops the direction counts the bias the same way in both signs: b is then near 0 in the whole log, and
// the counts are not. One that stands still counts the same in both.

#include <cstdint>
#include <string>

#include <zlg/core/compensation/compensation_constants.hpp>
#include <zlg/core/records.hpp>

namespace zlg::rig {

class BiasCheck {
public:
    // gyro  its bias and tick say which b is one; a bias that differs by up to a factor of four is seen as well.
    explicit BiasCheck(const core::CompensationConstants& gyro);

    void take(const core::HalfRecord& half);

    // One line where 32 halves in a row contradict the columns, whatever lies between them that shows no bias, or where
    // nearly all halves count the bias one way, or none; else empty.
    [[nodiscard]] std::string complaint(const std::string& log_name) const;
    // The first of both: it holds whatever the bias is.
    [[nodiscard]] bool is_contradicted() const { return lasts_; }

private:
    struct Pair {
        core::HalfRecord before{};
        core::HalfRecord half{};
    };

    void compare(const Pair& pair);
    [[nodiscard]] bool counts_one_way(const Pair& pair) const;

    double presumed_counts_;  // of the bias in a half
    double least_counts_;     // of one that is judged
    core::HalfRecord last_{};
    bool has_last_ = false;
    std::int64_t n_pairs_ = 0;
    std::int64_t n_one_way_ = 0;
    std::int64_t n_equal_ = 0;
    Pair first_one_way_{};
    std::int64_t n_judged_ = 0;
    std::int64_t n_wrong_ = 0;
    int n_in_a_row_ = 0;
    Pair first_in_row_{};
    bool lasts_ = false;
    Pair first_wrong_{};
};

}  // namespace zlg::rig
