#pragma once
// The rows of an HDF5 log: blocks of them are read, checked and handed out row by row.

#include <algorithm>
#include <cstdint>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

#include "column_map.hpp"
#include "hdf5_column.hpp"
#include "log_io.hpp"
#include "settings_lines.hpp"

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
    template <class T, class Rule> void take(Column<T>& column, const Rule& rule) {
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
    // Reads the good rows, or those before the first that cannot be read; returns how many are integers of type T. A
    // read fails as a whole; ever smaller pieces lead to the first row that cannot be read.
    template <class T> std::size_t read(Column<T>& column) {
        const std::size_t asked = good_rows_;
        std::size_t readable = 0, fitting = 0;
        for (std::size_t piece = asked; piece > 0;) {
            try {
                fitting = column.read_block(first_ + readable, piece);
                readable += piece;
                piece = std::min(piece, asked - readable);
            } catch (const std::runtime_error&) {
                damage_ = std::current_exception();
                good_rows_ = readable;
                piece /= 2;
            }
        }
        if (good_rows_ == asked) return fitting;
        good_rows_ = readable;
        return readable > 0 ? column.read_block(first_, readable) : 0;
    }

    const Source* source_;
    hsize_t first_ = 0;
    std::size_t n_ = 0;
    std::size_t good_rows_ = 0;
    std::exception_ptr damage_;
};

// The rows of an HDF5 log: blocks of them are read, checked and handed out row by row.
template <class Table> class TableSource : public LogSource<Table> {
public:
    bool next(typename Table::Row& row) override {
        if (n_handed_out_ == block_.good_rows() && !next_block()) return false;
        for_each_column<Table>(columns_, [&row, i = n_handed_out_](const auto& field, const auto& column, std::size_t) {
            field.set(row, column.is_open() ? column[i] : field.absent);
        });
        ++n_handed_out_;
        return true;
    }

    // The row is handed out again by the next call of `next`.
    [[noreturn]] void refuse_last(std::string_view name, std::int64_t value, const std::string& what) override {
        --n_handed_out_;
        throw block_.complaint(n_handed_out_, fmt::format("{}/{}", Table::group, name), fmt::format("{}", value), what);
    }

    bool refresh() override {
        if (this->header_.complete) return false;
        const hsize_t rows_before = rows_;
        this->header_.complete = source_.is_complete();
        for (DataSet* set : opened_) set->refresh();
        measure();
        return rows_ > rows_before;
    }

    [[nodiscard]] double fraction_read() const override {
        return rows_ > 0 ? static_cast<double>(block_end_) / static_cast<double>(rows_) : 0.0;
    }

    [[nodiscard]] bool has(std::size_t column) const { return map_.field_of[column].has_value(); }

protected:
    // Completeness is read before any length: of a complete log those are the last ones.
    //
    // errors  IoError; FormatError: see Source and map_columns; no group of that path.
    TableSource(const std::string& path, std::span<const KnownColumn> known) : source_{path}, block_{source_} {
        this->header_.complete = source_.is_complete();
        if (!source_.has(Table::group))
            throw FormatError(fmt::format("{}: the group {} is missing", path, Table::group));
        map_ = map_columns(known, source_.members(Table::group), fmt::format("{}, {}", path, Table::group));
        this->header_.warnings = map_.warnings;
        for_each_column<Table>(columns_,
                               [this](const auto& field, auto& column, std::size_t k) { open(k, field.name, column); });
    }

    // Opens a column, if the log has it. It must stay where it is as long as the source lives.
    template <class T> void open(std::size_t column, const char* name, Column<T>& opened, int max_width = 0) {
        if (has(column)) add({source_, fmt::format("{}/{}", Table::group, name), max_width}, opened);
    }
    template <class T> void add(Column<T>&& found, Column<T>& opened) {
        opened = std::move(found);
        opened_.push_back(&opened);
    }

    // How many rows are whole; to be called when all columns are open. A fingerprint that stands already in a log
    // without its last rows is not theirs.
    //
    // errors  FormatError: a complete log with no rows or with columns of different length.
    void measure() {
        const auto [shortest, longest] = std::ranges::minmax_element(opened_, {}, &DataSet::rows);
        rows_ = std::max(rows_, (*shortest)->rows());
        if (!this->header_.complete) return;
        if ((*shortest)->rows() != (*longest)->rows())
            throw FormatError(fmt::format("{}: {} has {} rows, {} has {}; allowed is one length", source_.path(),
                                          (*shortest)->path(), (*shortest)->rows(), (*longest)->path(),
                                          (*longest)->rows()));
        if (rows_ == 0) throw FormatError(fmt::format("{} is empty: no rows in {}", source_.path(), Table::group));
        this->header_.fingerprint = source_.text(fingerprint_path).value_or("");
        if (!this->header_.fingerprint.empty())
            require_fingerprint(this->header_.fingerprint, fmt::format("{}, {}", source_.path(), fingerprint_path));
    }

    // Reads and checks the other columns of a block.
    virtual void take_others(Block& block) = 0;

    // The place of the row that was read last in the values of a column; -1 before the first.
    [[nodiscard]] std::ptrdiff_t last_row() const { return static_cast<std::ptrdiff_t>(n_handed_out_) - 1; }

    Source source_;

private:
    // False at the end. Blocks end where chunks of our own logs do.
    //
    // errors  FormatError or IoError: what is wrong with the first row that was not handed out.
    bool next_block() {
        constexpr hsize_t rows_at_once = 16384;
        if (block_.is_damaged()) block_.fail();
        if (block_end_ == rows_) return false;
        n_handed_out_ = 0;
        block_.begin(block_end_, std::min(rows_at_once - block_end_ % rows_at_once, rows_ - block_end_));
        try {
            for_each_column<Table>(
                columns_, [this](const auto& field, auto& column, std::size_t) { block_.take(column, field.rule); });
            take_others(block_);
        } catch (...) {
            block_.begin(block_end_, 0);
            throw;
        }
        block_end_ = block_.end();
        if (block_.good_rows() == 0) block_.fail();
        return true;
    }

    ColumnMap map_;
    PartsOf<Table, Column> columns_;
    std::vector<DataSet*> opened_;
    hsize_t rows_ = 0;
    Block block_;
    hsize_t block_end_ = 0;         // the row behind the block
    std::size_t n_handed_out_ = 0;  // rows of the block
};

}  // namespace zlg::logs::hdf5
