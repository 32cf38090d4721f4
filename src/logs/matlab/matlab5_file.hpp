#pragma once
// Files of MATLAB 5 (its level 5, `-v6`), as they are written: a head, then one matrix after the other.
//
// Written here and not by libmatio, which does not tell whether its bytes reached the disk.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <zlg/logs/table_file.hpp>

namespace zlg::logs {

// MATLAB reads no larger variable of this level.
inline constexpr std::size_t max_matlab5_bytes = (std::size_t{1} << 31) - 1;

class Matlab5File {
public:
    // errors  IoError: as TableFile.
    Matlab5File(const std::string& path, bool force);

    // A matrix of doubles by columns, of `rows` rows. Its numbers may be stored in a shorter type that holds them;
    // MATLAB makes doubles of them.
    //
    // errors  IoError.
    template <class Number> void add(std::string_view name, std::span<const Number> values, std::size_t rows);
    void add(std::string_view name, double value) { add(name, std::span<const double>{&value, 1}, 1); }

    // A row of characters; what is no UTF-8 becomes some other letters. errors  IoError.
    void add_text(std::string_view name, std::string_view utf8);

    // errors  IoError.
    void close() { file_.close(); }
    [[nodiscard]] const std::string& part_path() const { return file_.part_path(); }

private:
    void add_matrix(std::string_view name, std::uint32_t matrix_class, std::size_t rows, std::size_t columns,
                    std::uint32_t type, std::string_view data);

    TableFile file_;
};

}  // namespace zlg::logs
