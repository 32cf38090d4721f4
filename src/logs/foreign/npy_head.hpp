#pragma once
// The head of a NumPy array: a dictionary of Python with three keys.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace zlg::logs {

struct NpyHead {
    std::string descr;
    bool fortran_order = false;
    std::vector<std::size_t> shape;
};

// Any spelling that Python has for texts without a backslash, True, False and tuples of decimal numbers; empty: another
// type, or no such dictionary.
[[nodiscard]] std::optional<NpyHead> npy_head(std::string_view text);

}  // namespace zlg::logs
