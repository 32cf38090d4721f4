#pragma once
// What a file of another program may cost: so much of it is allowed before any memory is taken for it.

#include <cstddef>
#include <cstdint>
#include <string>

namespace zlg::logs {

class Budget {
public:
    // A million values of any file, and four a byte of it: numbers of 8 bytes that are compressed to a thirtieth.
    Budget(std::string path, std::size_t file_bytes);

    [[nodiscard]] std::size_t max_values() const { return max_values_; }

    // errors  FormatError: with those before more values, or objects, than are allowed.
    void take_values(std::size_t rows, std::size_t columns);
    void take_object();

    // Bytes of what is unpacked into memory.
    void take_unpacked(std::size_t bytes);

    // Pieces that a reader looks up one by one, and those that are packed unpacks whole, whatever they hold of the
    // values: of each 32 values, or a quarter of those that are unpacked.
    void take_chunks(std::size_t n, std::size_t unpacked_values_of_one);

private:
    std::string path_;
    std::size_t file_bytes_;
    std::size_t max_values_;
    std::size_t n_values_ = 0;
    std::size_t n_for_chunks_ = 0;
    std::size_t n_objects_ = 0;
    std::size_t n_unpacked_ = 0;
};

// What is looked at of a file before it is asked for rows.
inline constexpr std::size_t max_looked_at = std::size_t{1} << 18;

// Rows that may be filled in where a file lacks them: ten times those that it has, and an hour at 100 Hz in any case.
[[nodiscard]] std::int64_t max_missing_rows(std::size_t n_rows);

}  // namespace zlg::logs
