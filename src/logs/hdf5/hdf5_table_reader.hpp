#pragma once
// The columns of an HDF5 log, and how many rows of them are whole.

#include <array>
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
    TableReader(const std::string& path, std::string group, std::span<const zlg::logs::Column> columns);
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

    // The block that begins with this row; blocks end where chunks of our own logs do.
    [[nodiscard]] std::size_t block_size(hsize_t first) const;

private:
    Source source_;
    bool is_complete_;
    std::string group_;
    std::span<const zlg::logs::Column> columns_;
    ColumnMap map_;
    std::vector<DataSet*> opened_;
    hsize_t rows_ = 0;
};

}  // namespace zlg::logs::hdf5
