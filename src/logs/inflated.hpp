#pragma once
// A stream of zlib, unpacked piece by piece: what it makes is the taker's to keep or to pass over.

#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>

namespace zlg::logs {

class Inflated {
public:
    // Reads packed bytes, `n` from `at` on.
    using Read = std::function<void(std::size_t at, std::size_t n, char* to)>;

    Inflated(std::size_t n_packed, Read read);
    ~Inflated();

    // The next bytes; returns how many, fewer than `n` only where the stream ends or is damaged.
    std::size_t next(std::size_t n, char* to);
    // The end was reached, and all was as its checksum says.
    [[nodiscard]] bool is_whole() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// `take` says whether to go on. Returns whether the stream of `n_packed` bytes is whole and all of it was taken.
[[nodiscard]] bool inflate_all(std::size_t n_packed, const Inflated::Read& read,
                               const std::function<bool(std::string_view)>& take);

}  // namespace zlg::logs
