#pragma once
// XXH64 of bytes that come piece by piece.

#include <cstdint>
#include <memory>
#include <string_view>

// The hash is part of the sources that include this: no library has to be there where the program runs.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace zlg::sweep {

class ContentHash {
public:
    ContentHash() { XXH64_reset(state_.get(), 0); }

    void add(std::string_view bytes) { XXH64_update(state_.get(), bytes.data(), bytes.size()); }
    [[nodiscard]] std::uint64_t value() const { return XXH64_digest(state_.get()); }

private:
    std::unique_ptr<XXH64_state_t, decltype(&XXH64_freeState)> state_{XXH64_createState(), XXH64_freeState};
};

}  // namespace zlg::sweep
