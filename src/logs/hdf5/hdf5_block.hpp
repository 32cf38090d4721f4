#pragma once
// A block of rows of several columns, and the first row in it that is not good.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <zlg/logs/error.hpp>

#include "hdf5_column.hpp"

namespace zlg::logs::hdf5 {

// The index of the first of n values that the rule does not allow; n: it allows all. Looks for it only when there is
// one, so that the loop over a good column is vectorised.
template <class T, class Rule>
std::size_t first_bad(const T* values, std::size_t n, const Rule& rule, std::int64_t first_row) {
    const auto is_good = [&](std::size_t i) {
        return rule.allows(values[i], first_row + static_cast<std::int64_t>(i));
    };
    bool all_good = true;
    for (std::size_t i = 0; i < n; ++i) all_good &= is_good(i);
    if (all_good) return n;
    std::size_t i = 0;
    while (is_good(i)) ++i;
    return i;
}

class Block {
public:
    explicit Block(const Source& source) : source_{&source} {}

    void begin(hsize_t first, std::size_t n) {
        first_ = first;
        n_ = n;
        good_rows_ = n;
        damage_ = nullptr;
    }

    [[nodiscard]] hsize_t end() const { return first_ + n_; }
    [[nodiscard]] std::size_t good_rows() const { return good_rows_; }
    [[nodiscard]] bool is_damaged() const { return good_rows_ < n_; }

    // Reads the block of a column and judges it, if the log has the column. With several values in a row, which only
    // columns of reals have, the rule does not ask for the number of the row.
    template <class T, class Rule>
    void take(Column<T>& column, const Rule& rule) {
        if (!column.is_open()) return;
        const std::size_t width = column.width();
        const std::size_t whole = read(column) * width;
        const auto first_row = static_cast<std::int64_t>(first_);
        const std::size_t bad = first_bad(column.values(), whole, rule, first_row);
        if (bad / width >= good_rows_) return;
        good_rows_ = bad / width;
        const auto note = [&](auto value) {
            const std::string what = rule.fault(value, first_row + static_cast<std::int64_t>(good_rows_));
            damage_ = std::make_exception_ptr(complaint(good_rows_, column.path(), fmt::format("{}", value), what));
        };
        if constexpr (std::is_integral_v<T>)
            note(column.integer(first_ + good_rows_));
        else
            note(column.values()[bad]);
    }

    // Of a value in a row of the block.
    [[nodiscard]] FormatError complaint(std::size_t row, const std::string& column, const std::string& value,
                                        const std::string& what) const {
        return FormatError(
            fmt::format("{}, row {}, column '{}': '{}' {}", source_->path(), first_ + row + 1, column, value, what));
    }

    // Complains of the row behind the good ones. errors  FormatError or IoError, always.
    [[noreturn]] void fail() const { std::rethrow_exception(damage_); }

private:
    // Reads the good rows, or those before the first that cannot be read; returns how many are integers of type T.
    template <class T>
    std::size_t read(Column<T>& column) {
        if (good_rows_ == 0) return 0;
        try {
            return column.read_block(first_, good_rows_);
        } catch (const std::runtime_error&) {
            return read_before_damage(column);
        }
    }

    // A read fails as a whole; ever smaller pieces lead to the first row that cannot be read.
    template <class T>
    std::size_t read_before_damage(Column<T>& column) {
        std::size_t readable = 0;
        for (std::size_t beyond = good_rows_; readable < beyond;) {
            const std::size_t piece = std::max<std::size_t>((beyond - readable) / 2, 1);
            if (can_read(column, first_ + readable, piece)) {
                readable += piece;
            } else if (piece > 1) {
                beyond = readable + piece;
            } else {
                break;
            }
        }
        good_rows_ = readable;
        return readable > 0 ? column.read_block(first_, readable) : 0;
    }

    template <class T>
    bool can_read(Column<T>& column, hsize_t first, std::size_t n) {
        try {
            column.read_block(first, n);
            return true;
        } catch (const std::runtime_error&) {
            damage_ = std::current_exception();
            return false;
        }
    }

    const Source* source_;
    hsize_t first_ = 0;
    std::size_t n_ = 0;
    std::size_t good_rows_ = 0;
    std::exception_ptr damage_;
};

}  // namespace zlg::logs::hdf5
