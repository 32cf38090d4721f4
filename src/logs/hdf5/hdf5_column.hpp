#pragma once
// One column of an HDF5 log, read in blocks of rows, and the pieces in which it is stored.
//
// The library unpacks a whole piece however much that makes, by whatever filter the file names, and hands out zeros for
// one that was never written.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
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

// One column of an HDF5 log, read in blocks of rows.
//
// How a column must look.
struct Shape {
    bool is_integer = true;  // a column of reals may hold integers, one of integers no reals
    int max_width = 0;       // two-dimensional, with so many values in a row at most; 0: one-dimensional
};

class DataSet {
public:
    DataSet() = default;

    // errors  FormatError: no data set, another shape, numbers of more than 8 bytes, stored outside the file, chunks of
    // more than 64 MiB, or packed by a filter that is not allowed.
    DataSet(const Source& source, std::string path, Shape shape);

    [[nodiscard]] bool is_open() const { return set_.is_open(); }
    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] hsize_t rows() const { return rows_; }
    [[nodiscard]] std::size_t width() const { return width_; }  // values in a row
    [[nodiscard]] bool holds(hid_t type) const { return H5Tequal(type_.get(), type) > 0; }

    // Looks how long the data set is by now.
    void refresh();

    // Rows first..first+n-1.
    //
    // errors  IoError, FormatError: damaged, behind the end of a file that was cut off, never written to a log that is
    // not complete.
    void read(hsize_t first, std::size_t n, hid_t type, void* values) const;

private:
    void measure();
    void check_type(const Shape& shape) const;
    void check_storage();
    void check_chunks(hsize_t first, std::size_t n) const;
    [[nodiscard]] std::string place(hsize_t first, std::size_t n) const;

    const Source* source_ = nullptr;
    std::string path_;
    Handle set_;
    Handle type_;
    Handle space_;
    int rank_ = 1;
    hsize_t rows_ = 0;
    std::size_t width_ = 1;
    Chunks chunks_;
    mutable hsize_t checked_until_ = 0;  // where the chunk ends that was read last
};

template <class T> class Column : public DataSet {
public:
    Column() = default;
    Column(const Source& source, std::string path, int max_width = 0)
        : DataSet{source, std::move(path), {!std::is_floating_point_v<T>, max_width}},
          is_direct_{std::is_floating_point_v<T> || std::is_same_v<T, std::int64_t> || holds(memory_type<T>())} {}

    // Of the block that was read last.
    [[nodiscard]] const T* values() const { return values_.data(); }
    [[nodiscard]] T operator[](std::size_t row) const { return values_[row]; }

    // Reads rows first..first+n-1; returns how many of them from the first on hold integers that a T can hold.
    std::size_t read_block(hsize_t first, std::size_t n) {
        values_.resize(n * width());
        if (is_direct_) {
            read(first, n, memory_type<T>(), values_.data());
            return n;
        }
        std::vector<std::int64_t> wide(n);
        read(first, n, H5T_NATIVE_INT64, wide.data());
        for (std::size_t i = 0; i < n; ++i) {
            values_[i] = static_cast<T>(wide[i]);
            if (static_cast<std::int64_t>(values_[i]) != wide[i]) return i;
        }
        return n;
    }

    // One integer as the file has it.
    [[nodiscard]] std::int64_t integer(hsize_t row) const {
        std::int64_t value = 0;
        read(row, 1, H5T_NATIVE_INT64, &value);
        return value;
    }

private:
    bool is_direct_ = true;
    std::vector<T> values_;
};

}  // namespace zlg::logs::hdf5
