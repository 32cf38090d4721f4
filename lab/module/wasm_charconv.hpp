#pragma once
// What <charconv> of libc++ 14 lacks: std::from_chars of a real number, as C++17 has it, by fast_float. Included before every source of
// the module that reads TOML.

#include <charconv>

#include <fast_float/fast_float.h>

namespace std {

inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const fast_float::from_chars_result read = fast_float::from_chars(first, last, value);
    return {read.ptr, read.ec};
}

}  // namespace std
