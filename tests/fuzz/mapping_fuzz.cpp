// Bytes as a mapping, as a file and as pairs: refused with a reason, or what was understood is written and read again
// alike.

#include <string>

#include <zlg/logs/error.hpp>
#include <zlg/logs/mapping.hpp>

#include "claim.hpp"
#include "scratch.hpp"

namespace {

using namespace zlg;

void claim_survives(const logs::Mapping& mapping) {
    const std::string toml = mapping.toml();
    logs::Mapping again;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(toml.data());
    logs::apply_mapping_file(again, fuzz::scratch().write("again.toml", bytes, toml.size()));
    fuzz::claim(again.toml() == toml, "a mapping is written as it was read");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        logs::Mapping mapping;
        logs::apply_mapping_file(mapping, fuzz::scratch().write("mapping.toml", data, size));
        claim_survives(mapping);
    } catch (const logs::MappingError&) {
        // No mapping.
    }
    try {
        logs::Mapping mapping;
        logs::apply_mapping_pair(mapping, std::string{reinterpret_cast<const char*>(data), size});
        claim_survives(mapping);
    } catch (const logs::MappingError&) {
        // No pair.
    }
    return 0;
}
