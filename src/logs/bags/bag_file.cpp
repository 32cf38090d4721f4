#include "bag_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <zlg/logs/error.hpp>
#include <zlg/text/escape.hpp>

namespace zlg::logs::bags {

namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 16;
constexpr std::size_t max_channels = 10'000;

}  // namespace

BagFile::BagFile(const std::string& path, const TakeMessage& take)
    : in{[this] {
             const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(block_bytes, bytes_.size() - n_read_));
             block_.resize(n);
             if (n > 0) bytes_.read(n_read_, n, block_.data());
             n_read_ += n;
             return std::string_view{block_};
         },
         ByteStream::End::of_file},
      may_unpack{0},
      path_{path},
      take_{take},
      bytes_{Piece::of_file(path)} {
    may_unpack = (std::uint64_t{1} << 26) + 260 * static_cast<std::uint64_t>(bytes_.size());
}

void BagFile::fail(const std::string& what) const {
    throw FormatError(fmt::format("{}: what begins at byte {} {}", path_, record_at, what));
}

void BagFile::add(BagChannel channel) {
    if (channels_.size() >= max_channels)
        throw Damaged(fmt::format("is one channel too many; allowed are {}", max_channels));
    const auto [found, is_new] = channels_.try_emplace(channel.number, channel);
    const BagChannel& known = found->second;
    if (!is_new && (known.topic != channel.topic || known.type != channel.type || known.encoding != channel.encoding))
        throw Damaged(fmt::format("makes channel {} '{}', which was '{}'; allowed is one meaning", channel.number,
                                  text::excerpt(channel.topic, 60, ' '), text::excerpt(known.topic, 60, ' ')));
}

BagChannel& BagFile::channel(std::uint32_t number) {
    const auto found = channels_.find(number);
    if (found == channels_.end())
        throw Damaged(fmt::format("holds a message of channel {}, which was not declared before", number));
    return found->second;
}

void BagFile::message(ByteStream& from, std::uint32_t number, std::int64_t received_ns, std::uint64_t n_bytes) {
    BagChannel& channel = this->channel(number);
    ++channel.n_messages;
    std::string_view data;
    if (channel.is_imu())
        data = from.take(n_bytes);
    else
        from.skip(n_bytes);
    take_({.channel = channel, .received_ns = received_ns, .data = data});
}

void BagFile::check_counts(const std::map<std::uint32_t, std::uint64_t>& said) const {
    for (const auto& [number, channel] : channels_) {
        const auto found = said.find(number);
        const std::uint64_t due = found == said.end() ? 0 : found->second;
        if (due != channel.n_messages)
            throw FormatError(fmt::format("{}: '{}' has {} messages; by the index of the bag expected are {}", path_,
                                          text::excerpt(channel.topic, 60, ' '), channel.n_messages, due));
    }
}

}  // namespace zlg::logs::bags
