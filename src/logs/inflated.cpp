#include "inflated.hpp"

#include <zlib.h>

#include <algorithm>
#include <string>
#include <utility>

namespace zlg::logs {

namespace {

constexpr std::size_t block = std::size_t{1} << 16;

}  // namespace

// It stays where it is made: zlib holds on to the place of `stream`.
struct Inflated::State {
    State(std::size_t n, Read from) : n_packed{n}, read{std::move(from)} {}

    std::size_t n_packed;
    Read read;
    std::size_t at = 0;
    std::string in = std::string(std::min(block, n_packed), '\0');
    z_stream stream{};
    int last = inflateInit(&stream);
};

Inflated::Inflated(std::size_t n_packed, Read read) : state_{std::make_unique<State>(n_packed, std::move(read))} {}
Inflated::~Inflated() { inflateEnd(&state_->stream); }

std::size_t Inflated::next(std::size_t n, char* to) {
    z_stream& stream = state_->stream;
    stream.next_out = reinterpret_cast<Bytef*>(to);
    stream.avail_out = static_cast<uInt>(n);
    while (state_->last == Z_OK && stream.avail_out > 0) {
        if (stream.avail_in == 0) {
            const std::size_t more =
                std::min(block, state_->n_packed - state_->at);  // 0: what is left comes of what was read
            state_->read(state_->at, more, state_->in.data());
            state_->at += more;
            stream.next_in = reinterpret_cast<Bytef*>(state_->in.data());
            stream.avail_in = static_cast<uInt>(more);
        }
        state_->last = inflate(&stream, Z_NO_FLUSH);
    }
    return n - stream.avail_out;
}

bool Inflated::is_whole() const { return state_->last == Z_STREAM_END; }

bool inflate_all(std::size_t n_packed, const Inflated::Read& read, const std::function<bool(std::string_view)>& take) {
    Inflated stream{n_packed, read};
    std::string out(block, '\0');
    while (const std::size_t n = stream.next(block, out.data()))
        if (!take(std::string_view{out}.substr(0, n))) return false;
    return stream.is_whole();
}

}  // namespace zlg::logs
