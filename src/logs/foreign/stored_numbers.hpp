#pragma once
// A matrix of numbers as it lies in a file, packed or not; read where it is wanted.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "file_descriptor.hpp"
#include "foreign_readers.hpp"

namespace zlg::logs {

// A stretch of bytes.
class Piece {
public:
    Piece() = default;

    // The whole file. errors  IoError.
    [[nodiscard]] static Piece of_file(const std::string& path);
    // What a stream of zlib makes, so many bytes; it is unpacked anew where it is read before the place that was read
    // last.
    [[nodiscard]] static Piece of_packed(const Piece& packed, std::size_t size);

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool is_packed() const;
    // `at` + `n` may not lie beyond the end.
    [[nodiscard]] Piece part(std::size_t at, std::size_t n) const;
    // errors  IoError: the file has become shorter, or cannot be read.
    void read(std::size_t at, std::size_t n, char* to) const;
    [[nodiscard]] std::string text(std::size_t at, std::size_t n) const;

private:
    struct Source;
    std::shared_ptr<Source> source_;
    std::size_t begin_ = 0;
    std::size_t size_ = 0;
};

enum class NumberType { i1, u1, i2, u2, i4, u4, i8, u8, f4, f8 };

[[nodiscard]] std::size_t size_of(NumberType type);

struct StoredMatrix {
    // n times m numbers, of which those of the last index, or else of the first, lie side by side: the longer side are
    // the rows.
    void take_shape(std::size_t n, std::size_t m, bool last_index_follows);

    Piece bytes;
    NumberType type = NumberType::f8;
    bool swapped = false;
    std::size_t rows = 0;
    std::size_t columns = 1;
    bool rows_follow = true;  // the numbers of a row lie side by side; else those of a column do
};

[[nodiscard]] ForeignArray array_of(const std::string& name, const StoredMatrix& stored);

}  // namespace zlg::logs
