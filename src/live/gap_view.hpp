#pragma once
// The newest gap of the measurement, with the ticks around it, for a picture.

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include <zlg/core/records.hpp>

namespace zlg::live {

struct GapView {
    std::int64_t first_row = 0;  // of the gap
    std::int64_t n_ticks = 0;    // of the gap
    std::int64_t end_row = 0;    // the picture was whole with the row before
    std::int64_t shown_row = 0;  // of the first of `rows`
    std::vector<core::AngleRow> rows;
};

// Finds gaps, ticks in which the loop was open or a count invalid, as the rows come.
class GapFinder {
public:
    static constexpr std::int64_t before_ticks = 12;
    static constexpr std::int64_t after_ticks = 40;
    static constexpr std::int64_t most_ticks = 400;  // of a gap that is shown

    void take(std::int64_t row, const core::AngleRow& angle) {
        const bool is_open = (angle.flags & (core::flag_loop_unlocked | core::flag_invalid)) != 0;
        recent_.push_back(angle);
        if (!first_ && std::int64_t(recent_.size()) > before_ticks + (is_open ? 1 : 0)) recent_.pop_front();
        if (is_open && (!first_ || row == end_)) {
            if (!first_) begin(row);
            end_ = row + 1;
        }
        if (first_ && (row + 1 - end_ >= after_ticks || row - *first_ >= most_ticks)) complete(row + 1);
    }

    [[nodiscard]] const std::optional<GapView>& newest() const { return newest_; }

private:
    void begin(std::int64_t row) {
        first_ = row;
        shown_ = row + 1 - std::int64_t(recent_.size());
    }

    void complete(std::int64_t end_row) {
        newest_ = GapView{*first_, end_ - *first_, end_row, shown_, {recent_.begin(), recent_.end()}};
        recent_.clear();
        first_.reset();
    }

    std::deque<core::AngleRow> recent_;
    std::optional<std::int64_t> first_;  // of the gap that is being looked at
    std::int64_t end_ = 0;               // of it
    std::int64_t shown_ = 0;
    std::optional<GapView> newest_;
};

}  // namespace zlg::live
