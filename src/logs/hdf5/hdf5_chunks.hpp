#pragma once
// The pieces in which a data set is stored: the library unpacks a whole one however much that makes, by whatever filter
// the file names, and hands out zeros for one that was never written.

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "hdf5_source.hpp"

namespace zlg::logs::hdf5 {

using Index = std::array<hsize_t, 2>;

// So that a packed chunk is kept where it is at most of so many bytes.
[[nodiscard]] Handle access_with_cache(std::size_t bytes);

class Chunks {
public:
    Chunks() = default;

    // Of a data set of one or two dimensions, in `source` by `path`.
    //
    // errors  FormatError: chunks of more than `max_bytes`; filters other than shuffle, deflate and fletcher32.
    Chunks(const Source& source, const std::string& path, hid_t set, std::size_t max_bytes);

    // Values of one in each dimension; 0: the data set is in one piece.
    [[nodiscard]] const Index& size() const { return size_; }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }
    [[nodiscard]] bool are_packed() const { return are_packed_; }

    // Begins of those of a block of values that were never written. The others may be read.
    //
    // errors  IoError; FormatError: one that unpacks to more or less than its values.
    [[nodiscard]] std::vector<Index> unwritten(const Source& source, const std::string& path, hid_t set,
                                               const Index& begin, const Index& count) const;

private:
    void take_filters(const Source& source, const std::string& path, hid_t creation);
    void check_packed(const Source& source, const std::string& path, hid_t set, const Index& at,
                      std::size_t packed) const;

    Index size_{0, 0};
    std::size_t bytes_ = 0;
    bool are_packed_ = false;
    // Filters as bits of the mask that a chunk has of those that it went without.
    unsigned deflate_ = 0;
    std::vector<unsigned> sums_within_, sums_;  // within what is deflated, and all: each adds 4 bytes
};

}  // namespace zlg::logs::hdf5
