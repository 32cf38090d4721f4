// An angle log of any bytes.

#include "recognised.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace zlg;
    const std::string path = fuzz::scratch().write("angles.csv", data, size);
    (void)fuzz::recognised(path);
    if (const std::optional<fuzz::AngleLog> log = fuzz::read_angles(path)) fuzz::claim_angles_survive(*log);
    return 0;
}
