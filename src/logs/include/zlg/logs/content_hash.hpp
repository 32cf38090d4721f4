#pragma once
// XXH64 of bytes that come piece by piece, and of files: `xxhsum -H64` gives the same.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace zlg::logs {

class ContentHash {
public:
    ContentHash();
    ~ContentHash();
    ContentHash(ContentHash&&) noexcept;

    void add(std::string_view bytes);
    [[nodiscard]] std::uint64_t value() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

[[nodiscard]] std::uint64_t content_hash(std::string_view bytes);

// errors  IoError: it is no regular file, or cannot be read.
[[nodiscard]] std::uint64_t hash_of_file(const std::string& path);

}  // namespace zlg::logs
