// Bytes as a MATLAB 5 file.

#include "foreign_claims.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    zlg::fuzz::claim_foreign(data, size, "foreign.mat");
    return 0;
}
