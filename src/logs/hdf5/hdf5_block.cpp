#include "hdf5_block.hpp"

#include <zlg/logs/error.hpp>

namespace zlg::logs::hdf5 {

void Block::begin(hsize_t first, std::size_t n) {
    first_ = first;
    n_ = n;
    good_rows_ = n;
    damage_ = nullptr;
}

void Block::note(const std::string& column, const std::string& value, const std::string& what) {
    damage_ = std::make_exception_ptr(FormatError(fmt::format("{}, row {}, column '{}': '{}' {}", source_->path(),
                                                              first_ + good_rows_ + 1, column, value, what)));
}

void Block::fail() const { std::rethrow_exception(damage_); }

}  // namespace zlg::logs::hdf5
