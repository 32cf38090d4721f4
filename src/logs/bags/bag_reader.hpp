#pragma once
// What the readers of both kinds of bags share: from the first record to the last, or to where the file was cut off.

#include <cstdint>
#include <map>
#include <string>

#include "bag.hpp"
#include "byte_stream.hpp"
#include "foreign/stored_numbers.hpp"

namespace zlg::logs::bags {

class BagReader {
public:
    BagReader(const std::string& path, const TakeMessage& take);
    BagReader(const BagReader&) = delete;
    virtual ~BagReader() = default;

    // errors  as read_mcap(), which returns what this does.
    [[nodiscard]] std::string read();

protected:
    // errors  CutOff, Damaged, as all that follow.
    virtual void take_signature(ByteStream& in) = 0;
    virtual void take_record(ByteStream& in, bool is_in_chunk) = 0;
    // Behind the last message; what follows is an index.
    [[nodiscard]] virtual bool has_all() = 0;
    [[nodiscard]] virtual bool is_closed() = 0;
    // The file has its end, so that it was not cut off.
    [[nodiscard]] virtual bool has_end() const = 0;

    void add(BagChannel channel);
    // A chunk of `n_packed` bytes to come, `size` of them unpacked with this checksum; 0: it has none.
    void take_chunk(std::string_view compression, std::uint64_t n_packed, std::uint64_t size, std::uint32_t crc);
    // The rest of a message.
    void take_message(ByteStream& in, std::uint32_t channel, std::int64_t received_ns, std::uint64_t n_bytes);
    // errors  FormatError, always: of the record that is being read.
    [[noreturn]] void fail(const std::string& what) const;

    [[nodiscard]] std::uint64_t at() const { return in_.at(); }
    [[nodiscard]] bool is_at_end() { return in_.is_at_end(); }
    [[nodiscard]] const Piece& bytes() const { return bytes_; }

    std::map<std::uint32_t, std::uint64_t> said_counts;  // messages of each channel, by the index; empty: not said

private:
    [[nodiscard]] std::string read_index();
    void next();
    void check_counts() const;

    ByteStream in_;
    std::string path_;
    const TakeMessage& take_;
    Piece bytes_;
    std::uint64_t may_unpack_;
    std::string block_;
    std::uint64_t n_read_ = 0;
    std::uint64_t record_at_ = 0;
    std::map<std::uint32_t, BagChannel> channels_;
};

}  // namespace zlg::logs::bags
