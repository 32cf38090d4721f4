#include "hdf5_chunks.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <vector>

namespace zlg::logs::hdf5 {

namespace {

// So many bytes unpack to 64 MiB at most: zlib makes 1032 of one.
constexpr hsize_t harmless_bytes = hsize_t{1} << 16;

int count_deflate(hid_t creation) {
    int n = 0;
    for (int k = 0; k < H5Pget_nfilters(creation); ++k) {
        unsigned flags = 0, config = 0;
        std::size_t n_values = 0;
        const H5Z_filter_t filter =
            H5Pget_filter2(creation, static_cast<unsigned>(k), &flags, &n_values, nullptr, 0, nullptr, &config);
        n += filter == H5Z_FILTER_DEFLATE ? 1 : 0;
    }
    return n;
}

bool unpacks_to_more(std::vector<Bytef>& packed, std::size_t most) {
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) return false;
    std::vector<Bytef> out(std::size_t{1} << 16);
    stream.next_in = packed.data();
    stream.avail_in = static_cast<uInt>(packed.size());
    std::size_t n = 0;
    for (int state = Z_OK; state == Z_OK && n <= most;) {
        stream.next_out = out.data();
        stream.avail_out = static_cast<uInt>(out.size());
        state = inflate(&stream, Z_NO_FLUSH);
        n += out.size() - stream.avail_out;
    }
    inflateEnd(&stream);
    return n > most;
}

}  // namespace

namespace {

// The library unpacks a whole chunk however much that makes.
void refuse_bombs(const Source& source, const std::string& path, hid_t set, const std::array<hsize_t, 2>& chunk,
                  const std::array<hsize_t, 2>& size, hsize_t unpacked) {
    for (std::array<hsize_t, 2> at{0, 0}; at[0] < size[0]; at[0] += chunk[0]) {
        for (at[1] = 0; at[1] < size[1]; at[1] += chunk[1]) {
            hsize_t bytes = 0;
            if (H5Dget_chunk_storage_size(set, at.data(), &bytes) < 0) source.fail_to_read(path);
            if (bytes <= harmless_bytes) continue;
            if (bytes > unpacked + unpacked / 8)
                source.fail(path, fmt::format("a chunk of {} bytes, which holds {}", bytes, unpacked));
            std::vector<Bytef> packed(bytes);
            std::uint32_t skipped = 0;
            if (H5Dread_chunk(set, H5P_DEFAULT, at.data(), &skipped, packed.data()) < 0) source.fail_to_read(path);
            if (unpacks_to_more(packed, unpacked))
                source.fail(path, fmt::format("a chunk that unpacks to more than its {} bytes", unpacked));
        }
    }
}

}  // namespace

std::array<hsize_t, 2> checked_chunk(const Source& source, const std::string& path, hid_t set, std::size_t max_bytes) {
    const Handle creation{H5Dget_create_plist(set), &H5Pclose};
    const Handle type{H5Dget_type(set), &H5Tclose};
    const Handle space{H5Dget_space(set), &H5Sclose};
    std::array<hsize_t, 2> chunk{1, 1}, size{1, 1};
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank < 1 || rank > 2) source.fail_to_read(path);
    H5Sget_simple_extent_dims(space.get(), size.data(), nullptr);
    if (H5Pget_layout(creation.get()) != H5D_CHUNKED) return size;
    if (H5Pget_chunk(creation.get(), rank, chunk.data()) != rank) source.fail_to_read(path);
    const hsize_t value_bytes = std::max<std::size_t>(H5Tget_size(type.get()), 1), most = max_bytes / value_bytes;
    if (chunk[0] > most || chunk[1] > most / std::max<hsize_t>(chunk[0], 1))
        source.fail(path, fmt::format("chunks of {} x {} values; allowed are {}", chunk[0], chunk[1], most));
    const int n_deflate = count_deflate(creation.get());
    if (n_deflate > 1) source.fail(path, "is packed twice; allowed is once");
    if (n_deflate > 0 && H5Dget_storage_size(set) > harmless_bytes)
        refuse_bombs(source, path, set, chunk, size, chunk[0] * chunk[1] * value_bytes + 64);
    return chunk;
}

}  // namespace zlg::logs::hdf5
