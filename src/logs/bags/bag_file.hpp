#pragma once
// What the readers of both kinds of bags share: the file, its channels, what was counted.

#include <cstdint>
#include <map>
#include <string>

#include "bag.hpp"
#include "byte_stream.hpp"
#include "foreign/stored_numbers.hpp"

namespace zlg::logs::bags {

class BagFile {
public:
    BagFile(const std::string& path, const TakeMessage& take);
    BagFile(const BagFile&) = delete;

    // errors  FormatError, always: of what begins at `record_at`.
    [[noreturn]] void fail(const std::string& what) const;

    // errors  Damaged: it is there already, as another one.
    void add(BagChannel channel);
    // errors  Damaged: there is none of that number.
    [[nodiscard]] BagChannel& channel(std::uint32_t number);

    // The rest of a record, of so many bytes: a message.
    void message(ByteStream& in, std::uint32_t number, std::int64_t received_ns, std::uint64_t n_bytes);

    // What the bag itself says of its messages.
    //
    // errors  FormatError: others were read.
    void check_counts(const std::map<std::uint32_t, std::uint64_t>& said) const;

    [[nodiscard]] const Piece& bytes() const { return bytes_; }

    ByteStream in;
    std::uint64_t record_at = 0;
    std::uint64_t may_unpack;

private:
    std::string path_;
    const TakeMessage& take_;
    Piece bytes_;
    std::string block_;
    std::uint64_t n_read_ = 0;
    std::map<std::uint32_t, BagChannel> channels_;
};

}  // namespace zlg::logs::bags
