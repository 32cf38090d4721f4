// ROS 1 bags: http://wiki.ros.org/Bags/Format/2.0.

#include <fmt/format.h>

#include "bag_reader.hpp"
#include "fields.hpp"

namespace zlg::logs::bags {

namespace {

constexpr std::string_view rosbag_magic = "#ROSBAG V2.0\n";

enum RosbagKind : std::uint8_t {
    rosbag_message = 2,
    rosbag_header = 3,
    rosbag_index = 4,
    rosbag_chunk = 5,
    rosbag_chunk_info = 6,
    rosbag_connection = 7,
};

// Fields `name=value`.
class NamedFields {
public:
    explicit NamedFields(std::string_view bytes) {
        Fields fields{bytes};
        while (fields.left() > 0) {
            const std::string_view field = fields.text();
            const std::size_t equals = field.find('=');
            if (equals == std::string_view::npos) throw Damaged("has a field without '='; allowed is name=value");
            values_[std::string{field.substr(0, equals)}] = field.substr(equals + 1);
        }
    }

    // errors  Damaged: there is none; of a number also one of another length.
    [[nodiscard]] std::string text(const char* name) const {
        const auto found = values_.find(name);
        if (found == values_.end()) throw Damaged(fmt::format("has no field '{}'", name));
        return found->second;
    }
    template <class Number> [[nodiscard]] Number number(const char* name) const {
        const std::string value = text(name);
        if (value.size() != sizeof(Number))
            throw Damaged(
                fmt::format("has a field '{}' of {} bytes; allowed are {}", name, value.size(), sizeof(Number)));
        return Fields{value}.number<Number>();
    }

private:
    std::map<std::string, std::string> values_;
};

class RosbagReader : public BagReader {
public:
    using BagReader::BagReader;

private:
    void take_signature(ByteStream& in) override {
        if (in.take(rosbag_magic.size()) != rosbag_magic)
            throw Damaged("is no ROS bag of version 2.0; `rosbag migrate` of ROS makes one");
    }
    [[nodiscard]] bool has_all() override {
        if (index_at_ != 0 && at() > index_at_)
            throw Damaged(
                fmt::format("ends at byte {}; by the head of the bag its index begins at {}", at(), index_at_));
        return at() == index_at_ || is_at_end();
    }
    [[nodiscard]] bool is_closed() override { return is_at_end(); }
    [[nodiscard]] bool has_end() const override { return index_at_ != 0 && index_at_ <= bytes().size(); }

    void take_record(ByteStream& in, bool is_in_chunk) override {
        const bool is_in_index = !is_in_chunk && index_at_ != 0 && at() >= index_at_;
        const auto n_header = Fields{in.take(4)}.number<std::uint32_t>();
        const NamedFields header{in.take(n_header)};
        const auto kind = header.number<std::uint8_t>("op");
        const auto size = Fields{in.take(4)}.number<std::uint32_t>();
        const bool is_known = kind >= rosbag_message && kind <= rosbag_connection;
        if (!is_known || (is_in_chunk && kind != rosbag_message && kind != rosbag_connection))
            throw Damaged(fmt::format("holds a record of kind {}; allowed are {}", kind,
                                      is_in_chunk ? "2 and 7 in a chunk" : "2..7"));
        if (is_in_index && (kind == rosbag_message || kind == rosbag_chunk))
            fail("holds messages behind the beginning of the index; allowed are connections");
        switch (kind) {
            case rosbag_message: return take_data(in, header, size);
            case rosbag_chunk:
                return take_chunk(header.text("compression"), size, header.number<std::uint32_t>("size"), 0);
            case rosbag_connection: return take_connection(header, in.take(size));
            case rosbag_header: index_at_ = header.number<std::uint64_t>("index_pos"); break;
            case rosbag_index:
                said_counts[header.number<std::uint32_t>("conn")] += header.number<std::uint32_t>("count");
                break;
            default: break;
        }
        in.skip(size);
    }

    void take_data(ByteStream& in, const NamedFields& header, std::uint32_t size) {
        const auto time = header.number<std::uint64_t>("time");  // seconds, and above them nanoseconds
        const auto seconds = static_cast<std::int64_t>(time & 0xffffffffU),
                   rest = static_cast<std::int64_t>(time >> 32U);
        if (rest >= 1'000'000'000) throw Damaged(fmt::format("has a time of {} ns beside seconds", rest));
        take_message(in, header.number<std::uint32_t>("conn"), seconds * 1'000'000'000 + rest, size);
    }

    void take_connection(const NamedFields& header, std::string_view data) {
        add({.number = header.number<std::uint32_t>("conn"),
             .topic = header.text("topic"),
             .type = NamedFields{data}.text("type"),
             .encoding = "ros1"});
    }

    std::uint64_t index_at_ = 0;  // 0: not closed
};

}  // namespace

std::string read_rosbag(const std::string& path, const TakeMessage& take) { return RosbagReader{path, take}.read(); }

}  // namespace zlg::logs::bags
