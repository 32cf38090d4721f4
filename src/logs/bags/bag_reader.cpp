#include "bag_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <zlg/logs/error.hpp>
#include <zlg/text/escape.hpp>

#include "unpacked.hpp"

namespace zlg::logs::bags {

namespace {

constexpr std::uint64_t block_bytes = std::uint64_t{1} << 16;
constexpr std::size_t max_channels = 10'000;

}  // namespace

BagReader::BagReader(const std::string& path, const TakeMessage& take)
    : in_{[this] {
              block_.resize(std::min(block_bytes, bytes_.size() - n_read_));
              if (!block_.empty()) bytes_.read(n_read_, block_.size(), block_.data());
              n_read_ += block_.size();
              return std::string_view{block_};
          },
          ByteStream::End::of_file},
      path_{path},
      take_{take},
      bytes_{Piece::of_file(path)},
      may_unpack_{(std::uint64_t{1} << 26) + 260 * std::uint64_t{bytes_.size()}} {}

std::string BagReader::read() {
    try {
        take_signature(in_);
        while (!has_all()) next();
    } catch (const CutOff&) {
        if (has_end()) fail("goes on behind the end of the file, which is there; allowed are whole records");
        return fmt::format("is cut off within what begins at byte {}; what stands before is taken", record_at_);
    } catch (const Damaged& damage) {
        fail(damage.what());
    }
    if (!has_end()) return "was not closed by its recorder, or is cut off; what stands in it is taken";
    return read_index();
}

// An index that is not whole says nothing.
std::string BagReader::read_index() {
    try {
        while (!is_closed()) next();
    } catch (const CutOff&) {
        return "has an index that is cut off; it is not needed";
    } catch (const Damaged&) {
        return "has an index that is damaged; it is not needed";
    }
    check_counts();
    return {};
}

void BagReader::next() {
    record_at_ = in_.at();
    take_record(in_, false);
}

void BagReader::fail(const std::string& what) const {
    throw FormatError(fmt::format("{}: what begins at byte {} {}", path_, record_at_, what));
}

void BagReader::add(BagChannel channel) {
    if (channels_.size() >= max_channels)
        throw Damaged(fmt::format("is one channel too many; allowed are {}", max_channels));
    const BagChannel& known = channels_.try_emplace(channel.number, channel).first->second;
    if (known.topic != channel.topic || known.type != channel.type || known.encoding != channel.encoding)
        throw Damaged(fmt::format("makes channel {} '{}', which was '{}'; allowed is one meaning", channel.number,
                                  text::excerpt(channel.topic, 60, ' '), text::excerpt(known.topic, 60, ' ')));
}

void BagReader::take_chunk(std::string_view compression, std::uint64_t n_packed, std::uint64_t size,
                           std::uint32_t crc) {
    ByteStream records = unpacked(in_, compression, n_packed, may_unpack_);
    while (!records.is_at_end()) take_record(records, true);
    if (records.at() != size)
        throw Damaged(fmt::format("is a chunk of {} bytes; by its head expected are {}", records.at(), size));
    if (crc != 0 && records.crc() != crc)
        throw Damaged(
            fmt::format("is a chunk whose checksum is {:08x}; by its head expected is {:08x}", records.crc(), crc));
}

void BagReader::take_message(ByteStream& in, std::uint32_t channel, std::int64_t received_ns, std::uint64_t n_bytes) {
    const auto found = channels_.find(channel);
    if (found == channels_.end())
        throw Damaged(fmt::format("holds a message of channel {}, which was not declared before", channel));
    ++found->second.n_messages;
    std::string_view data;
    if (found->second.is_imu())
        data = in.take(n_bytes);
    else
        in.skip(n_bytes);
    take_({.channel = found->second, .received_ns = received_ns, .data = data});
}

void BagReader::check_counts() const {
    for (const auto& [number, channel] : channels_) {
        const auto said = said_counts.find(number);
        const std::uint64_t due = said == said_counts.end() ? 0 : said->second;
        if (!said_counts.empty() && due != channel.n_messages)
            throw FormatError(fmt::format("{}: '{}' has {} messages; by the index of the bag expected are {}", path_,
                                          text::excerpt(channel.topic, 60, ' '), channel.n_messages, due));
    }
}

}  // namespace zlg::logs::bags
