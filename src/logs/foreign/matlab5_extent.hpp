#pragma once
// Whether a MATLAB 5 file holds the bytes that it says it holds: libmatio gives memory that nobody wrote where they are missing.

#include <string>

namespace zlg::logs {

// errors  FormatError: an element that ends behind the file or its parent, a matrix whose dimensions are not those of its numbers,
// a compressed element that is damaged; names the byte. IoError.
void check_matlab5_extent(const std::string& path);

}  // namespace zlg::logs
