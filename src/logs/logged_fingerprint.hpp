#pragma once
// The fingerprint of a run in a log: room that is made before the rows and filled when all of them are there.

#include <cstddef>
#include <string>
#include <string_view>

#include <zlg/logs/settings.hpp>

namespace zlg::logs {

inline constexpr std::size_t fingerprint_digits = 16;

// HDF5: a scalar text, zeros until it is filled.
inline constexpr const char* fingerprint_path = "/fingerprint";

// CSV: the first line of the file, with dots for the digits until it is filled.
inline constexpr std::string_view fingerprint_line = "# fingerprint = ";
inline constexpr std::string_view no_fingerprint = "................";

// errors  FormatError: not 16 hexadecimal digits in lower case; names `place`.
void require_fingerprint(const std::string& fingerprint, const std::string& place);

// errors  FormatError: the log at `path` was begun without room for one.
[[noreturn]] void refuse_fingerprint(const std::string& path);

// The fingerprint that stands among the lines of a CSV log, which it leaves; empty where there is none. A line of that
// name with another value is a note of a laboratory, and stays.
//
// errors  FormatError: two of them that differ; names `path`.
[[nodiscard]] std::string take_fingerprint(Settings& settings, const std::string& path);

}  // namespace zlg::logs
