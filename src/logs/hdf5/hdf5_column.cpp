#include "hdf5_column.hpp"

#include <fmt/format.h>

namespace zlg::logs::hdf5 {

namespace {

constexpr std::size_t max_chunk_bytes = std::size_t{64} << 20;
constexpr std::size_t max_kept_bytes = std::size_t{16} << 20;  // of each column
constexpr std::size_t max_number_bytes = 8;

}  // namespace

DataSet::DataSet(const Source& source, std::string path, Shape shape) : source_{&source}, path_{std::move(path)} {
    const auto open = [&](std::size_t cache_bytes) {
        const Handle access = access_with_cache(cache_bytes);
        set_.close();  // or the library would go on with the cache that it has
        set_ = {H5Dopen2(source.id(), path_.c_str(), access.get()), &H5Dclose};
        if (!set_.is_open()) source.fail(path_, "is no data set that can be read: " + last_failure().reason);
    };
    open(0);
    type_ = {H5Dget_type(set_.get()), &H5Tclose};
    space_ = {H5Dget_space(set_.get()), &H5Sclose};
    check_type(shape);
    const int dimensions = H5Sget_simple_extent_ndims(space_.get());
    rank_ = shape.max_width > 0 ? 2 : 1;
    if (dimensions != rank_) source.fail(path_, fmt::format("has {} dimensions; allowed is {}", dimensions, rank_));
    measure();
    if (shape.max_width > 0 && !(width_ >= 1 && width_ <= static_cast<std::size_t>(shape.max_width))) {
        source.fail(path_, fmt::format("has {} values in a row; allowed is 1..{}", width_, shape.max_width));
    }
    check_storage();
    // A packed chunk that does not stay in memory is unpacked for every block of rows anew.
    if (chunks_.are_packed() && chunks_.bytes() <= max_kept_bytes) open(chunks_.bytes());
}

void DataSet::check_type(const Shape& shape) const {
    const H5T_class_t kind = H5Tget_class(type_.get());
    // Python writes a truth value as an enumeration of two integers.
    const bool is_integer = kind == H5T_INTEGER || kind == H5T_ENUM;
    const bool is_good = is_integer || (kind == H5T_FLOAT && !shape.is_integer);
    if (!is_good || H5Tget_size(type_.get()) > max_number_bytes) {
        source_->fail(path_, fmt::format("holds another type; allowed are {} of at most {} bytes",
                                         shape.is_integer ? "integers" : "numbers", max_number_bytes));
    }
}

void DataSet::check_storage() {
    const Handle creation{H5Dget_create_plist(set_.get()), &H5Pclose};
    if (H5Pget_external_count(creation.get()) != 0 || H5Pget_layout(creation.get()) == H5D_VIRTUAL) {
        source_->fail(path_, "is stored in another file; allowed is a data set of this file");
    }
    chunks_ = {*source_, path_, set_.get(), max_chunk_bytes};
}

void DataSet::measure() {
    std::array<hsize_t, 2> size{0, 1};
    if (H5Sget_simple_extent_dims(space_.get(), size.data(), nullptr) != rank_) source_->fail_to_read(path_);
    rows_ = size[0];
    width_ = size[1];
}

void DataSet::refresh() {
    if (H5Drefresh(set_.get()) < 0) source_->fail_to_read(path_);
    space_ = {H5Dget_space(set_.get()), &H5Sclose};
    measure();
}

std::string DataSet::place(hsize_t first, std::size_t n) const {
    return n == 1 ? fmt::format("{}, row {}", path_, first + 1)
                  : fmt::format("{}, rows {}..{}", path_, first + 1, first + n);
}

// A complete log may mean the zeros of a chunk that was never written; an interrupted one has lost the numbers.
void DataSet::check_chunks(hsize_t first, std::size_t n) const {
    const hsize_t rows = chunks_.size()[0];
    const bool must_be_written = rows != 0 && !source_->is_complete();
    if (!must_be_written && !chunks_.are_packed()) return;
    const hsize_t from = first / rows * rows + rows == checked_until_ ? checked_until_ : first;
    if (from >= first + n) return;
    const auto lost = chunks_.unwritten(*source_, path_, set_.get(), {from, 0}, {first + n - from, width_});
    if (must_be_written && !lost.empty()) source_->fail(place(first, n), "was never written; the log was interrupted");
    checked_until_ = (first + n + rows - 1) / rows * rows;
}

void DataSet::read(hsize_t first, std::size_t n, hid_t type, void* values) const {
    check_chunks(first, n);
    const std::array<hsize_t, 2> start{first, 0};
    const std::array<hsize_t, 2> count{n, width_};
    const Handle block{H5Screate_simple(rank_, count.data(), nullptr), &H5Sclose};
    if (H5Sselect_hyperslab(space_.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
        H5Dread(set_.get(), type, block.get(), space_.get(), H5P_DEFAULT, values) < 0) {
        source_->fail_to_read(place(first, n));
    }
}

}  // namespace zlg::logs::hdf5
