#pragma once
// What the sources of both logs share: blocks of rows are read, checked and handed out row by row.

#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "hdf5_fields.hpp"
#include "hdf5_table_reader.hpp"
#include "row_rules.hpp"

namespace zlg::logs::hdf5 {

template <class Source>  // RawSource or AngleSource
class TableSource : public Source {
public:
    TableSource(const std::string& path, const std::string& group, std::span<const zlg::logs::Column> columns)
        : table_{path, group, columns}, block_{table_.source()} {}

    bool refresh() override {
        const bool grown = table_.refresh();
        this->header_.complete = table_.is_complete();
        return grown;
    }

    [[nodiscard]] double fraction_read() const override {
        return table_.rows() > 0 ? static_cast<double>(block_end_) / static_cast<double>(table_.rows()) : 0.0;
    }

protected:
    // Reads and checks the columns of a block whose first row is this one.
    virtual void take_columns(std::int64_t first) = 0;

    template <class Fields, class Columns>
    void open_fields(const Fields& fields, Columns& columns) {
        for_each_field(fields, columns, [this](const auto& field, auto& column) { table_.open(field.column, column); });
    }

    // The next row; false at the end.
    template <class Fields, class Columns, class Row>
    bool next_row(const Fields& fields, const Columns& columns, Row& row) {
        if (n_handed_out_ == block_.good_rows() && !next_block()) return false;
        for_each_field(fields, columns, [&row, i = n_handed_out_](const auto& field, const auto& column) {
            set_member(field, row, column.is_open() ? column[i] : field.absent);
        });
        ++n_handed_out_;
        return true;
    }

    void take_indices(Column<std::int64_t>& column, std::int64_t first) {
        block_.take(
            column, [first](std::int64_t v, std::size_t i) { return v == first + static_cast<std::int64_t>(i); },
            [this, first](std::int64_t v) {
                if (v < 0) return out_of_range(range(0, std::numeric_limits<std::int64_t>::max()));
                return out_of_order(v, first + static_cast<std::int64_t>(block_.good_rows()));
            });
    }

    void take_signs(Column<std::int8_t>& column) {
        block_.take(
            column, [](std::int8_t v, std::size_t) { return (v == 1) | (v == -1); },
            [](std::int64_t) { return out_of_range(allowed_sign); });
    }

    // Any number that its type can hold; `least` is the least that is allowed.
    template <class T>
    void take_integers(Column<T>& column, std::int64_t least = std::numeric_limits<T>::min()) {
        if (!column.is_open()) return;
        block_.take(
            column, [](T, std::size_t) { return true; },
            [least](std::int64_t) { return out_of_range(range(least, std::numeric_limits<T>::max())); });
    }

    template <class T>
    void take_reals(Column<T>& column) {
        if (!column.is_open()) return;
        block_.take(
            column, [](T v, std::size_t) { return is_finite(v); }, [](T) { return std::string{not_finite}; });
    }

    TableReader table_;
    Block block_;
    std::size_t n_handed_out_ = 0;  // rows of the block

private:
    bool next_block() {
        if (block_.is_damaged()) block_.fail();
        if (block_end_ == table_.rows()) return false;
        n_handed_out_ = 0;
        block_.begin(block_end_, table_.block_size(block_end_));
        try {
            take_columns(static_cast<std::int64_t>(block_end_));
        } catch (...) {
            block_.begin(block_end_, 0);
            throw;
        }
        block_end_ = block_.end();
        if (block_.good_rows() == 0) block_.fail();
        return true;
    }

    hsize_t block_end_ = 0;  // row behind the block
};

}  // namespace zlg::logs::hdf5
