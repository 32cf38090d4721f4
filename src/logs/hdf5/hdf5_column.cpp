#include "hdf5_column.hpp"

#include <fmt/format.h>

#include "hdf5_chunks.hpp"

namespace zlg::logs::hdf5 {

namespace {

constexpr std::size_t max_chunk_bytes = std::size_t{64} << 20;
constexpr std::size_t max_number_bytes = 8;

// A packed chunk that does not stay in memory would be unpacked for every block of rows anew.
Handle access_with_cache(std::size_t bytes) {
    Handle access{H5Pcreate(H5P_DATASET_ACCESS), &H5Pclose};
    H5Pset_chunk_cache(access.get(), H5D_CHUNK_CACHE_NSLOTS_DEFAULT, bytes, H5D_CHUNK_CACHE_W0_DEFAULT);
    return access;
}

}  // namespace

DataSet::DataSet(const Source& source, std::string path, Shape shape) : source_{&source}, path_{std::move(path)} {
    const auto open = [&](std::size_t cache_bytes) {
        const Handle access = access_with_cache(cache_bytes);
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
    if (const std::size_t packed_bytes = check_storage(); packed_bytes > 0) open(packed_bytes);
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

// Returns how many bytes a packed chunk takes when it is unpacked; 0: nothing is packed.
std::size_t DataSet::check_storage() {
    const Handle creation{H5Dget_create_plist(set_.get()), &H5Pclose};
    const H5D_layout_t layout = H5Pget_layout(creation.get());
    if (H5Pget_external_count(creation.get()) != 0 || layout == H5D_VIRTUAL) {
        source_->fail(path_, "is stored in another file; allowed is a data set of this file");
    }
    if (layout != H5D_CHUNKED) return 0;
    chunk_ = checked_chunk(*source_, path_, set_.get(), max_chunk_bytes);
    return H5Pget_nfilters(creation.get()) > 0 ? chunk_[0] * chunk_[1] * H5Tget_size(type_.get()) : 0;
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

// The library hands out zeros for a chunk that was never written. A complete log may mean them; an interrupted one has
// lost the numbers.
void DataSet::require_written(hsize_t first, std::size_t n) const {
    if (chunk_[0] == 0 || source_->is_complete()) return;
    std::array<hsize_t, 2> at{first - first % chunk_[0], 0};
    for (; at[0] < first + n; at[0] += chunk_[0]) {
        for (at[1] = 0; at[1] < width_; at[1] += chunk_[1]) {
            hsize_t bytes = 0;
            if (H5Dget_chunk_storage_size(set_.get(), at.data(), &bytes) < 0) source_->fail_to_read(place(first, n));
            if (bytes == 0) source_->fail(place(first, n), "was never written; the log was interrupted");
        }
    }
}

void DataSet::read(hsize_t first, std::size_t n, hid_t type, void* values) const {
    require_written(first, n);
    const std::array<hsize_t, 2> start{first, 0};
    const std::array<hsize_t, 2> count{n, width_};
    const Handle block{H5Screate_simple(rank_, count.data(), nullptr), &H5Sclose};
    if (H5Sselect_hyperslab(space_.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
        H5Dread(set_.get(), type, block.get(), space_.get(), H5P_DEFAULT, values) < 0) {
        source_->fail_to_read(place(first, n));
    }
}

}  // namespace zlg::logs::hdf5
