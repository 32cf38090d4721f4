#include "unpacked.hpp"

#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <string>
#include <zlg/text/escape.hpp>

namespace zlg::logs::bags {

namespace {

constexpr std::size_t block_size = std::size_t{1} << 16;

// Takes of `in`, puts into `out` and says how much. Returns 0 where a frame has ended. errors  Damaged.
using Step = std::function<std::size_t(std::string_view& in, std::string& out, std::size_t& n_out)>;

Step lz4_step() {
    LZ4F_dctx* made = nullptr;
    if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) throw std::bad_alloc{};
    const std::shared_ptr<LZ4F_dctx> context{made, &LZ4F_freeDecompressionContext};
    return [context](std::string_view& in, std::string& out, std::size_t& n_out) {
        std::size_t n_in = in.size();
        n_out = out.size();
        const std::size_t left = LZ4F_decompress(context.get(), out.data(), &n_out, in.data(), &n_in, nullptr);
        if (LZ4F_isError(left) != 0)
            throw Damaged(
                fmt::format("has damaged data of LZ4 ({}); allowed are whole frames", LZ4F_getErrorName(left)));
        in.remove_prefix(n_in);
        return left;
    };
}

Step zstd_step() {
    const std::shared_ptr<ZSTD_DCtx> context{ZSTD_createDCtx(), &ZSTD_freeDCtx};
    return [context](std::string_view& in, std::string& out, std::size_t& n_out) {
        ZSTD_inBuffer from{in.data(), in.size(), 0};
        ZSTD_outBuffer to{out.data(), out.size(), 0};
        const std::size_t left = ZSTD_decompressStream(context.get(), &to, &from);
        if (ZSTD_isError(left) != 0)
            throw Damaged(
                fmt::format("has damaged data of Zstandard ({}); allowed are whole frames", ZSTD_getErrorName(left)));
        in.remove_prefix(from.pos);
        n_out = to.pos;
        return left;
    };
}

// Where a chunk is, packed, and as far as it is unpacked.
struct Packed {
    ByteStream& file;
    std::uint64_t n_left;
    std::uint64_t& allowed;
    Step step = {};  // none: it is stored
    std::string_view in = {};
    std::string out = {};
    std::size_t n_out = 0;
    std::size_t frame_left = 0;

    std::string_view next_packed() {
        if (n_left == 0) return {};
        const std::string_view some = file.take_some(n_left);
        n_left -= some.size();
        return some;
    }

    std::string_view next() {
        if (!step) return next_packed();
        n_out = 0;
        while (n_out == 0) {
            if (in.empty()) in = next_packed();
            const std::size_t before = in.size();
            if (before == 0 && frame_left == 0) return {};
            frame_left = step(in, out, n_out);
            if (n_out == 0 && before == 0)
                throw Damaged("its packed data end within a frame; allowed are whole frames");
        }
        if (n_out > allowed)
            throw Damaged("unpacks to more than a bag of its size may hold; allowed are 260 bytes a byte, and 64 MiB");
        allowed -= n_out;
        return std::string_view{out}.substr(0, n_out);
    }
};

}  // namespace

ByteStream unpacked(ByteStream& file, std::string_view compression, std::uint64_t n_packed, std::uint64_t& allowed) {
    const auto packed = std::make_shared<Packed>(Packed{.file = file, .n_left = n_packed, .allowed = allowed});
    if (compression == "lz4")
        packed->step = lz4_step();
    else if (compression == "zstd")
        packed->step = zstd_step();
    else if (!compression.empty() && compression != "none")
        throw Damaged(fmt::format("is compressed by '{}'; allowed are none, lz4 and zstd",
                                  text::excerpt(std::string{compression}, 20, '?')));
    if (packed->step) packed->out.resize(block_size);
    return {[packed] { return packed->next(); }, ByteStream::End::of_chunk};
}

}  // namespace zlg::logs::bags
