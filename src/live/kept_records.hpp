#pragma once
// What is kept of records in bounded memory for the pages.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include <zlg/core/records.hpp>

namespace zlg::live {

// Every stride-th value, from the first on; the stride is doubled whenever `capacity` of them are kept.
template <class Value, std::size_t capacity> class Thinned {
public:
    void add(const Value& value) {
        const bool is_kept = n_ % stride_ == 0;
        ++n_;
        if (!is_kept) return;
        if (kept_.size() == capacity) {
            for (std::size_t k = 0; 2 * k < capacity; ++k) kept_[k] = kept_[2 * k];
            kept_.resize((capacity + 1) / 2);
            stride_ *= 2;
            if ((n_ - 1) % stride_ != 0) return;
        }
        kept_.push_back(value);
    }

    [[nodiscard]] const std::vector<Value>& kept() const { return kept_; }
    [[nodiscard]] std::int64_t stride() const { return stride_; }

private:
    std::vector<Value> kept_;
    std::int64_t stride_ = 1;
    std::int64_t n_ = 0;
};

// The newest gap of the measurement, with the ticks around it, for a picture.
struct GapView {
    std::int64_t first_row = 0;        // of the gap
    std::int64_t n_ticks = 0;          // of the gap
    std::int64_t end_row = 0;          // the picture was whole with the row before
    std::int64_t shown_row = 0;        // of the first of `rows`
    std::vector<core::AngleRow> rows;  // of a long gap its beginning only
};

// Finds gaps, ticks in which the loop was open or a count invalid, as the rows come. A picture is whole when enough
// measured ticks have followed the gap, or the next one begins.
class GapFinder {
public:
    static constexpr std::int64_t before_ticks = 12;
    static constexpr std::int64_t after_ticks = 40;
    static constexpr std::int64_t most_rows = 460;  // of a picture

    void take(std::int64_t row, const core::AngleRow& angle) {
        const bool is_open = (angle.flags & (core::flag_loop_unlocked | core::flag_invalid)) != 0;
        if (first_ && (is_open ? row > end_ : row - end_ >= after_ticks)) complete(row);
        if (is_open && !first_) begin(row);
        if (is_open) end_ = row + 1;
        if (first_ && std::int64_t(shown_.size()) < most_rows) shown_.push_back(angle);
        before_.push_back(angle);
        if (std::int64_t(before_.size()) > before_ticks) before_.pop_front();
    }

    [[nodiscard]] const std::optional<GapView>& newest() const { return newest_; }

private:
    void begin(std::int64_t row) {
        first_ = row;
        shown_.assign(before_.begin(), before_.end());
    }

    void complete(std::int64_t row) {
        const std::int64_t shown_row = *first_ - first_before_ticks();
        newest_ = GapView{*first_, end_ - *first_, row, shown_row, std::move(shown_)};
        first_.reset();
    }

    // How many rows there were to show before the gap.
    [[nodiscard]] std::int64_t first_before_ticks() const { return std::min(*first_, before_ticks); }

    std::deque<core::AngleRow> before_;  // the last rows
    std::vector<core::AngleRow> shown_;  // of the gap that is being looked at
    std::optional<std::int64_t> first_;  // row of it
    std::int64_t end_ = 0;
    std::optional<GapView> newest_;
};

}  // namespace zlg::live
