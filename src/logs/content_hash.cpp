#include <zlg/logs/content_hash.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <vector>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>

// The hash is part of this source: no library has to be there where the program runs.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace zlg::logs {

struct ContentHash::State {
    XXH64_state_t xxh;
};

ContentHash::ContentHash() : state_{std::make_unique<State>()} { XXH64_reset(&state_->xxh, 0); }
ContentHash::~ContentHash() = default;
ContentHash::ContentHash(ContentHash&&) noexcept = default;

void ContentHash::add(std::string_view bytes) { XXH64_update(&state_->xxh, bytes.data(), bytes.size()); }
std::uint64_t ContentHash::value() const { return XXH64_digest(&state_->xxh); }

std::uint64_t content_hash(std::string_view bytes) { return XXH64(bytes.data(), bytes.size(), 0); }

std::uint64_t hash_of_file(const std::string& path) {
    require_regular_file(path);
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{std::fopen(path.c_str(), "rb"), std::fclose};
    if (!file) throw IoError(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
    ContentHash hash;
    std::vector<char> buffer(std::size_t{1} << 20);
    while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), file.get())) hash.add({buffer.data(), n});
    if (std::ferror(file.get()) != 0) throw IoError(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
    return hash.value();
}

}  // namespace zlg::logs
