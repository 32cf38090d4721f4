// MCAP, from the first record to the last.

#include <fmt/format.h>

#include <algorithm>
#include <zlg/text/escape.hpp>

#include "bag_reader.hpp"
#include "fields.hpp"
#include "mcap_kinds.hpp"

namespace zlg::logs::bags {

namespace {

// "sensor_msgs/msg/Imu" of ROS 2 as ROS 1 says it.
std::string ros_type(std::string_view name) {
    std::string type{name};
    if (const std::size_t at = type.find("/msg/"); at != std::string::npos) type.erase(at, 4);
    return type;
}

class McapReader : public BagReader {
public:
    using BagReader::BagReader;

private:
    void take_signature(ByteStream& in) override {
        if (in.take(mcap_magic.size()) != mcap_magic) throw Damaged("is no MCAP of version 0");
    }
    [[nodiscard]] bool has_all() override { return has_all_; }
    [[nodiscard]] bool is_closed() override { return is_closed_; }
    [[nodiscard]] bool has_end() const override {
        const std::size_t n = bytes().size();
        return has_all_ ||
               (n > mcap_magic.size() && bytes().text(n - mcap_magic.size(), mcap_magic.size()) == mcap_magic);
    }

    // The fields of a record, the rest of which says nothing here.
    [[nodiscard]] static std::string head_of(ByteStream& in, std::uint64_t size) {
        const std::uint64_t n = std::min<std::uint64_t>(size, max_piece);
        std::string head{in.take(n)};
        in.skip(size - n);
        return head;
    }

    void take_record(ByteStream& in, bool is_in_chunk) override {
        const std::uint32_t crc_before = in.crc();
        Fields fields{in.take(9)};
        const auto kind = fields.number<std::uint8_t>();
        const auto size = fields.number<std::uint64_t>();
        const bool is_of_messages = kind == mcap_schema || kind == mcap_channel || kind == mcap_message;
        if (kind == 0 || (is_in_chunk && !is_of_messages) || (kind > mcap_data_end && kind < mcap_private))
            throw Damaged(fmt::format("holds a record of kind 0x{:02x}; allowed are {}", kind,
                                      is_in_chunk ? "0x03..0x05 in a chunk" : "0x01..0x0f and 0x80..0xff"));
        if (has_all_ && (kind == mcap_message || kind == mcap_chunk))
            fail("holds messages behind the end of the data; allowed is the index");
        switch (kind) {
            case mcap_schema: return take_schema(head_of(in, size));
            case mcap_channel: return take_channel(head_of(in, size));
            case mcap_message: return take_data(in, size);
            case mcap_chunk: return take_records(in, size);
            case mcap_statistics: return take_statistics(head_of(in, size));
            case mcap_data_end: return take_data_end(in, size, crc_before);
            case mcap_footer: return take_footer(in, size);
            default: break;
        }
        in.skip(size);
    }

    void take_schema(const std::string& head) {
        Fields fields{head};
        const auto number = fields.number<std::uint16_t>();
        types_[number] = ros_type(fields.text());
    }

    void take_channel(const std::string& head) {
        Fields fields{head};
        const auto number = fields.number<std::uint16_t>();
        const auto schema = fields.number<std::uint16_t>();
        const std::string topic{fields.text()}, encoding{fields.text()};
        const auto type = types_.find(schema);
        if (schema != 0 && type == types_.end())
            throw Damaged(fmt::format("names the type {} of '{}', which was not declared before", schema,
                                      text::excerpt(topic, 60, ' ')));
        add({.number = number,
             .topic = topic,
             .type = type == types_.end() ? std::string{} : type->second,
             .encoding = encoding});
    }

    void take_data(ByteStream& in, std::uint64_t size) {
        constexpr std::uint64_t n_before = 22;
        if (size < n_before) throw Damaged(fmt::format("holds a message of {} bytes; allowed are 22 or more", size));
        Fields fields{in.take(n_before)};
        const auto number = fields.number<std::uint16_t>();
        (void)fields.number<std::uint32_t>();  // in sequence, where its publisher counts
        take_message(in, number, static_cast<std::int64_t>(fields.number<std::uint64_t>()), size - n_before);
    }

    void take_records(ByteStream& in, std::uint64_t size) {
        constexpr std::uint64_t n_before = 32, n_length = 8;
        Fields fields{in.take(n_before)};
        (void)fields.bytes(16);  // the times of its messages
        const auto n_unpacked = fields.number<std::uint64_t>();
        const auto crc = fields.number<std::uint32_t>();
        const auto n_word = fields.number<std::uint32_t>();
        const std::string compression{in.take(n_word)};
        const auto n_packed = Fields{in.take(n_length)}.number<std::uint64_t>();
        if (size - n_before - n_length - n_word != n_packed)
            throw Damaged(fmt::format("is a chunk of {} bytes with {} packed ones; expected are {}", size, n_packed,
                                      size - n_before - n_length - n_word));
        take_chunk(compression, n_packed, n_unpacked, crc);
    }

    void take_footer(ByteStream& in, std::uint64_t size) {
        in.skip(size);
        if (!has_all_) throw Damaged("is the footer, with no end of the data before it");
        if (in.take(mcap_magic.size()) != mcap_magic || !in.is_at_end()) throw Damaged("is not the end");
        is_closed_ = true;
    }

    void take_data_end(ByteStream& in, std::uint64_t size, std::uint32_t crc_before) {
        if (size != 4) throw Damaged(fmt::format("is the end of the data, of {} bytes; allowed are 4", size));
        const auto crc = Fields{in.take(4)}.number<std::uint32_t>();
        if (crc != 0 && crc != crc_before)
            throw Damaged(fmt::format("says that the checksum of the data is {:08x}; it is {:08x}", crc, crc_before));
        has_all_ = true;
    }

    void take_statistics(const std::string& head) {
        if (!has_all_) return;
        Fields fields{head};
        (void)fields.bytes(8 + 2 + 4 + 4 + 4 + 4 + 8 + 8);
        Fields counts{fields.text()};
        while (counts.left() > 0) {
            const auto number = counts.number<std::uint16_t>();
            said_counts[number] = counts.number<std::uint64_t>();
        }
    }

    std::map<std::uint16_t, std::string> types_;
    bool has_all_ = false;
    bool is_closed_ = false;
};

}  // namespace

std::string read_mcap(const std::string& path, const TakeMessage& take) { return McapReader{path, take}.read(); }

}  // namespace zlg::logs::bags
