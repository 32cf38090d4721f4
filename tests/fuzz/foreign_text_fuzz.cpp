// Bytes as a text of another program.

#include "foreign_claims.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    zlg::fuzz::claim_foreign(data, size, "foreign.csv");
    return 0;
}
