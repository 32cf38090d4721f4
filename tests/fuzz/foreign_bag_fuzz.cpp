// Bytes as a bag: MCAP or ROS 1, by what they begin with.

#include "foreign_claims.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    zlg::fuzz::claim_foreign(data, size, "foreign.mcap");
    return 0;
}
