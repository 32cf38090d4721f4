// Bytes as an array of NumPy, or as doubles without a header.

#include "foreign_claims.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    zlg::fuzz::claim_foreign(data, size, "foreign.npy");
    return 0;
}
