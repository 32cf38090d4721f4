#pragma once
// The columns of an HDF5 log, and how many rows of them are whole.

#include <span>
#include <string>
#include <vector>

#include "column_map.hpp"
#include "hdf5_block.hpp"
#include "hdf5_column.hpp"

namespace zlg::logs::hdf5 {

class TableReader {
public:
    // errors  IoError; FormatError: see Source and map_columns; no group of that path.
    TableReader(const std::string& path, std::string group, std::span<const KnownColumn> columns);
    TableReader(TableReader&&) = delete;

    [[nodiscard]] const Source& source() const { return source_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return map_.warnings; }
    [[nodiscard]] bool has(std::size_t column) const { return map_.field_of[column].has_value(); }

    // Opens a column, if the log has it. It must stay where it is as long as the reader lives.
    template <class T>
    void open(std::size_t column, Column<T>& opened, int max_width = 0) {
        if (!has(column)) return;
        opened = Column<T>{source_, group_ + "/" + std::string{columns_[column].name}, max_width};
        opened_.push_back(&opened);
    }
    void add(DataSet& opened) { opened_.push_back(&opened); }

    // How many rows are whole. errors  FormatError: a complete log with no rows or with columns of different length.
    void measure();

    // Looks for further rows. True: there are. errors  as measure.
    bool refresh();

    [[nodiscard]] hsize_t rows() const { return rows_; }
    [[nodiscard]] bool is_complete() const { return is_complete_; }

    // The block that was read last.
    [[nodiscard]] const Block& block() const { return block_; }

    // Goes to the next block: `take_columns(block)` reads and judges its columns. False at the end.
    //
    // errors  FormatError or IoError: what is wrong with the first row that was not handed out.
    template <class TakeColumns>
    bool next_block(TakeColumns take_columns) {
        if (block_.is_damaged()) block_.fail();
        if (block_end_ == rows_) return false;
        block_.begin(block_end_, block_size());
        try {
            take_columns(block_);
        } catch (...) {
            block_.begin(block_end_, 0);
            throw;
        }
        block_end_ = block_.end();
        if (block_.good_rows() == 0) block_.fail();
        return true;
    }

    // Of the rows, 0..1.
    [[nodiscard]] double fraction_read() const {
        return rows_ > 0 ? static_cast<double>(block_end_) / static_cast<double>(rows_) : 0.0;
    }

private:
    // Of the next block; blocks end where chunks of our own logs do.
    [[nodiscard]] std::size_t block_size() const;

    Source source_;
    bool is_complete_;
    std::string group_;
    std::span<const KnownColumn> columns_;
    ColumnMap map_;
    std::vector<DataSet*> opened_;
    hsize_t rows_ = 0;
    Block block_;
    hsize_t block_end_ = 0;  // the row behind the block
};

}  // namespace zlg::logs::hdf5
