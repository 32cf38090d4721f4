#include "inflated.hpp"

#include <zlib.h>

#include <algorithm>
#include <memory>
#include <string>

namespace zlg::logs {

bool inflate_all(std::size_t n_packed, const std::function<void(std::size_t, std::size_t, char*)>& read,
                 const std::function<bool(std::string_view)>& take) {
    constexpr std::size_t block = std::size_t{1} << 16;
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) return false;
    const std::unique_ptr<z_stream, int (*)(z_stream*)> end{&stream, &inflateEnd};
    std::string in(std::min(block, n_packed), '\0'), out(block, '\0');
    int state = Z_OK;
    for (std::size_t at = 0; state == Z_OK;) {
        if (stream.avail_in == 0) {
            const std::size_t n = std::min(block, n_packed - at);  // 0: what is left comes of what was read
            read(at, n, in.data());
            at += n;
            stream.next_in = reinterpret_cast<Bytef*>(in.data());
            stream.avail_in = static_cast<uInt>(n);
        }
        stream.next_out = reinterpret_cast<Bytef*>(out.data());
        stream.avail_out = static_cast<uInt>(block);
        state = inflate(&stream, Z_NO_FLUSH);
        if (!take(std::string_view{out}.substr(0, block - stream.avail_out))) return false;
    }
    return state == Z_STREAM_END;
}

}  // namespace zlg::logs
