#pragma once
// The results of a sweep as a file: columns of HDF5 with units, one row a gyro.
//
// The bytes are a function of the description and of the rows: in whatever order, by however many threads and parts
// they came.

#include <cstdint>
#include <map>
#include <string>

#include <zlg/sweep/description.hpp>
#include <zlg/sweep/gyros.hpp>

namespace zlg::sweep {

// By the number of the gyro. There may be fewer than the description has: those of a part, or of a merger of some
// parts.
using Rows = std::map<std::int64_t, Row>;

struct Results {
    std::string description;  // as to_toml made it
    Rows rows;
};

// Puts the file under its name, over another one that is there: whole or not at all.
//
// errors  logs::IoError.
void write_results(const std::string& path, const Gyros& gyros, const Rows& rows);

// errors  logs::IoError; logs::FormatError: no such file, damaged, or its rows are not those of its description.
[[nodiscard]] Results read_results(const std::string& path);

// Of a file that a sweep wrote, where nobody's words are to blame.
//
// errors  logs::FormatError.
[[nodiscard]] Description recorded_description(const std::string& text, const std::string& path);

// Adds the rows of one file to those of others.
//
// source  of them, for the message.
// errors  logs::FormatError: the two have a gyro in common and differ in it.
void add_rows(Rows& rows, const Rows& more, const std::string& source);

}  // namespace zlg::sweep
