#include "hdf5_chunks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
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

}  // namespace zlg::logs::hdf5
