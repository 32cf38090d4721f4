// A raw log of any bytes.

#include "recognised.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace zlg;
    const std::string path = fuzz::scratch().write("raw.csv", data, size);
    (void)fuzz::recognised(path);
    if (const std::optional<fuzz::RawLog> log = fuzz::read_raw(path)) fuzz::claim_raw_survives(*log);
    return 0;
}
