#include "hdf5_table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <zlg/logs/error.hpp>

namespace zlg::logs::hdf5 {

namespace {

constexpr std::size_t rows_at_once = 16384;

}  // namespace

// Completeness is read before any length: of a complete log those are the last ones.
TableReader::TableReader(const std::string& path, std::string group, std::span<const KnownColumn> columns)
    : source_{path}, is_complete_{source_.is_complete()}, group_{std::move(group)}, columns_{columns}, block_{source_} {
    if (!source_.has(group_)) throw FormatError(fmt::format("{}: the group {} is missing", path, group_));
    map_ = map_columns(columns, source_.members(group_), fmt::format("{}, {}", path, group_));
}

void TableReader::measure() {
    const auto [shortest, longest] = std::ranges::minmax_element(opened_, {}, &DataSet::rows);
    rows_ = std::max(rows_, (*shortest)->rows());
    if (!is_complete_) return;
    if ((*shortest)->rows() != (*longest)->rows()) {
        throw FormatError(fmt::format("{}: {} has {} rows, {} has {}; allowed is one length", source_.path(),
                                      (*shortest)->path(), (*shortest)->rows(), (*longest)->path(),
                                      (*longest)->rows()));
    }
    if (rows_ == 0) throw FormatError(fmt::format("{} is empty: no rows in {}", source_.path(), group_));
}

bool TableReader::refresh() {
    if (is_complete_) return false;
    const hsize_t rows_before = rows_;
    is_complete_ = source_.is_complete();
    for (DataSet* set : opened_) set->refresh();
    measure();
    return rows_ > rows_before;
}

std::size_t TableReader::block_size() const {
    return static_cast<std::size_t>(std::min<hsize_t>(rows_at_once - block_end_ % rows_at_once, rows_ - block_end_));
}

}  // namespace zlg::logs::hdf5
