#pragma once
// A claim about the product: where it does not hold, the input is a finding.

#include <cstdio>
#include <cstdlib>

namespace zlg::fuzz {

inline void claim(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "the claim fails: %s\n", what);
    std::abort();
}

}  // namespace zlg::fuzz
