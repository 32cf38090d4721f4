#include "hdf5_block.hpp"

namespace zlg::logs::hdf5 {

void Block::begin(hsize_t first, std::size_t n) {
    first_ = first;
    n_ = n;
    good_rows_ = n;
    damage_ = nullptr;
}

FormatError Block::complaint(std::size_t row, const std::string& column, const std::string& value,
                             const std::string& what) const {
    return FormatError(
        fmt::format("{}, row {}, column '{}': '{}' {}", source_->path(), first_ + row + 1, column, value, what));
}

void Block::fail() const { std::rethrow_exception(damage_); }

}  // namespace zlg::logs::hdf5
