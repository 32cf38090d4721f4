#include "hdf5_column.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include <zlg/text/escape.hpp>

#include "inflated.hpp"

namespace zlg::logs::hdf5 {
namespace {

constexpr std::size_t bytes_of_sum = 4;

// Those that the chunk did not go without.
std::size_t bytes_of(const std::vector<unsigned>& sums, unsigned skipped) {
    return bytes_of_sum *
           static_cast<std::size_t>(std::ranges::count_if(sums, [&](unsigned sum) { return (sum & skipped) == 0; }));
}

bool inflates_to(const std::vector<char>& packed, std::size_t bytes) {
    std::size_t n = 0;
    const auto read = [&packed](std::size_t at, std::size_t size, char* to) {
        std::memcpy(to, packed.data() + at, size);
    };
    return inflate_all(packed.size(), read, [&](std::string_view piece) { return (n += piece.size()) <= bytes; }) &&
           n == bytes;
}

}  // namespace

Handle access_with_cache(std::size_t bytes) {
    Handle access{H5Pcreate(H5P_DATASET_ACCESS), &H5Pclose};
    H5Pset_chunk_cache(access.get(), H5D_CHUNK_CACHE_NSLOTS_DEFAULT, bytes, H5D_CHUNK_CACHE_W0_DEFAULT);
    return access;
}

Chunks::Chunks(const Source& source, const std::string& path, hid_t set, std::size_t max_bytes) {
    const Handle creation{H5Dget_create_plist(set), &H5Pclose};
    if (H5Pget_layout(creation.get()) != H5D_CHUNKED) return;
    const Handle type{H5Dget_type(set), &H5Tclose};
    size_ = {1, 1};
    const int rank = H5Pget_chunk(creation.get(), 2, size_.data());
    if (rank < 1 || rank > 2) source.fail_to_read(path);
    const hsize_t value_bytes = std::max<std::size_t>(H5Tget_size(type.get()), 1), most = max_bytes / value_bytes;
    if (size_[0] > most || size_[1] > most / std::max<hsize_t>(size_[0], 1))
        source.fail(path, fmt::format("chunks of {} x {} values; allowed are {}", size_[0], size_[1], most));
    bytes_ = size_[0] * size_[1] * value_bytes;
    take_filters(source, path, creation.get());
}

// What a chunk takes is known of these alone; of others the file itself says how much.
void Chunks::take_filters(const Source& source, const std::string& path, hid_t creation) {
    const int n_filters = H5Pget_nfilters(creation);
    are_packed_ = n_filters > 0;
    for (int k = 0; k < n_filters; ++k) {
        unsigned flags = 0, config = 0;
        std::size_t n_values = 0;
        std::array<char, 64> name{};
        const H5Z_filter_t filter = H5Pget_filter2(creation, static_cast<unsigned>(k), &flags, &n_values, nullptr,
                                                   name.size() - 1, name.data(), &config);
        const unsigned bit = 1u << static_cast<unsigned>(k);
        if (filter == H5Z_FILTER_FLETCHER32) {
            sums_.push_back(bit);
            if (deflate_ == 0) sums_within_.push_back(bit);
        } else if (filter == H5Z_FILTER_DEFLATE && deflate_ == 0) {
            deflate_ = bit;
        } else if (filter != H5Z_FILTER_SHUFFLE || deflate_ != 0) {
            source.fail(path, fmt::format("is packed by filter {}, '{}'{}; allowed are shuffle, then deflate (gzip), "
                                          "and fletcher32",
                                          filter, text::excerpt(name.data(), 40, '?'),
                                          deflate_ != 0 ? ", behind deflate" : ""));
        }
    }
}

std::vector<Index> Chunks::unwritten(const Source& source, const std::string& path, hid_t set, const Index& begin,
                                     const Index& count) const {
    std::vector<Index> missing;
    if (size_[0] == 0) return missing;
    Index at{begin[0] - begin[0] % size_[0], 0};
    for (; at[0] < begin[0] + count[0]; at[0] += size_[0]) {
        for (at[1] = begin[1] - begin[1] % size_[1]; at[1] < begin[1] + count[1]; at[1] += size_[1]) {
            // The library fails for a chunk that is not there. One that it cannot find it will not read either.
            hsize_t packed = 0;
            if (H5Dget_chunk_storage_size(set, at.data(), &packed) < 0 || packed == 0)
                missing.push_back(at);
            else if (are_packed_)
                check_packed(source, path, set, at, packed);
        }
    }
    return missing;
}

void Chunks::check_packed(const Source& source, const std::string& path, hid_t set, const Index& at,
                          std::size_t packed) const {
    const auto fail = [&](const std::string& what) {
        source.fail(fmt::format("{}, row {}", path, at[0] + 1),
                    fmt::format("a chunk that {}; its values take {}", what, bytes_));
    };
    if (packed > bytes_ + bytes_ / 8 + 64) fail(fmt::format("takes {} bytes in the file", packed));
    std::vector<char> stored(packed);
    std::uint32_t skipped = 0;
    if (H5Dread_chunk(set, H5P_DEFAULT, at.data(), &skipped, stored.data()) < 0) source.fail_to_read(path);
    const bool is_deflated = deflate_ != 0 && (skipped & deflate_) == 0;
    const bool is_good = is_deflated ? inflates_to(stored, bytes_ + bytes_of(sums_within_, skipped))
                                     : packed == bytes_ + bytes_of(sums_, skipped);
    if (!is_good) fail("unpacks to more or fewer bytes");
}

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
