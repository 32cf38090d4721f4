// MCAP, from the first record to the last.

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <zlg/text/escape.hpp>

#include "bag_file.hpp"
#include "fields.hpp"
#include "mcap_kinds.hpp"
#include "unpacked.hpp"

namespace zlg::logs::bags {

namespace {

// "sensor_msgs/msg/Imu" of ROS 2 as ROS 1 says it.
std::string ros_type(std::string_view name) {
    std::string type{name};
    if (const std::size_t at = type.find("/msg/"); at != std::string::npos) type.erase(at, 4);
    return type;
}

class McapReader {
public:
    McapReader(const std::string& path, const TakeMessage& take) : bag_{path, take} {}

    std::string read() {
        try {
            if (bag_.in.take(mcap_magic.size()) != mcap_magic) throw Damaged("is no MCAP of version 0");
            while (!has_all_) next();
        } catch (const CutOff&) {
            if (ends_whole())
                bag_.fail("goes on behind the end of the file, which is there; allowed are whole records");
            return fmt::format("is cut off within what begins at byte {}; what stands before is taken", bag_.record_at);
        } catch (const Damaged& damage) {
            bag_.fail(damage.what());
        }
        return read_index();
    }

private:
    // All messages are read. An index that lacks its end says nothing.
    std::string read_index() {
        try {
            while (!is_closed_) next();
            if (bag_.in.take(mcap_magic.size()) != mcap_magic || !bag_.in.is_at_end()) throw Damaged("");
        } catch (const CutOff&) {
            return "its index is cut off; it is not needed";
        } catch (const Damaged&) {
            return "its index is damaged; it is not needed";
        }
        if (counts_) bag_.check_counts(*counts_);
        return {};
    }

    [[nodiscard]] bool ends_whole() const {
        const std::size_t n = bag_.bytes().size();
        return n > mcap_magic.size() && bag_.bytes().text(n - mcap_magic.size(), mcap_magic.size()) == mcap_magic;
    }

    void next() {
        bag_.record_at = bag_.in.at();
        take_record(bag_.in, false);
    }

    // The fields of a record, the rest of which says nothing here.
    [[nodiscard]] static std::string head_of(ByteStream& in, std::uint64_t size) {
        const std::uint64_t n = std::min<std::uint64_t>(size, max_piece);
        std::string head{in.take(n)};
        in.skip(size - n);
        return head;
    }

    void take_record(ByteStream& in, bool is_in_chunk) {
        const std::uint32_t crc_before = in.crc();
        Fields fields{in.take(9)};
        const auto kind = fields.number<std::uint8_t>();
        const auto size = fields.number<std::uint64_t>();
        const bool is_of_messages = kind == mcap_schema || kind == mcap_channel || kind == mcap_message;
        if (kind == 0 || (is_in_chunk && !is_of_messages) || (kind > mcap_data_end && kind < mcap_private))
            throw Damaged(fmt::format("holds a record of kind 0x{:02x}; allowed are {}", kind,
                                      is_in_chunk ? "0x03..0x05 in a chunk" : "0x01..0x0f and 0x80..0xff"));
        if (has_all_ && (kind == mcap_message || kind == mcap_chunk))
            bag_.fail("holds messages behind the end of the data; allowed is the index");
        switch (kind) {
            case mcap_schema:
                return take_schema(head_of(in, size));
            case mcap_channel:
                return take_channel(head_of(in, size));
            case mcap_message:
                return take_message(in, size);
            case mcap_chunk:
                return take_chunk(in, size);
            case mcap_statistics:
                return take_statistics(head_of(in, size));
            case mcap_data_end:
                return take_data_end(in, size, crc_before);
            case mcap_footer:
                if (!has_all_) throw Damaged("is the footer, with no end of the data before it");
                is_closed_ = true;
                break;
            default:
                break;
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
        bag_.add({.number = number,
                  .topic = topic,
                  .type = type == types_.end() ? std::string{} : type->second,
                  .encoding = encoding});
    }

    void take_message(ByteStream& in, std::uint64_t size) {
        constexpr std::uint64_t n_before = 22;
        if (size < n_before) throw Damaged(fmt::format("holds a message of {} bytes; allowed are 22 or more", size));
        Fields fields{in.take(n_before)};
        const auto number = fields.number<std::uint16_t>();
        (void)fields.number<std::uint32_t>();  // in sequence, where its publisher counts
        bag_.message(in, number, static_cast<std::int64_t>(fields.number<std::uint64_t>()), size - n_before);
    }

    void take_chunk(ByteStream& in, std::uint64_t size) {
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
        ByteStream records = unpacked(in, compression, n_packed, bag_.may_unpack);
        while (!records.is_at_end()) take_record(records, true);
        if (records.at() != n_unpacked)
            throw Damaged(fmt::format("is a chunk of {} bytes; by its head expected are {}", records.at(), n_unpacked));
        if (crc != 0 && records.crc() != crc)
            throw Damaged(
                fmt::format("is a chunk whose checksum is {:08x}; by its head expected is {:08x}", records.crc(), crc));
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
        counts_.emplace();
        while (counts.left() > 0) {
            const auto number = counts.number<std::uint16_t>();
            (*counts_)[number] = counts.number<std::uint64_t>();
        }
    }

    BagFile bag_;
    std::map<std::uint16_t, std::string> types_;
    std::optional<std::map<std::uint32_t, std::uint64_t>> counts_;
    bool has_all_ = false;
    bool is_closed_ = false;
};

}  // namespace

std::string read_mcap(const std::string& path, const TakeMessage& take) { return McapReader{path, take}.read(); }

}  // namespace zlg::logs::bags
