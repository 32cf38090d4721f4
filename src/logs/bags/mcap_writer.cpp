#include "mcap_writer.hpp"

#include <zlib.h>

#include "fields.hpp"
#include "mcap_kinds.hpp"

namespace zlg::logs::bags {

namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 20;  // as @mcap/core makes them
constexpr std::uint16_t number_of_one = 1;                 // of the type, and of the channel

std::uint32_t crc_of(std::string_view bytes, std::uint32_t before = 0) {
    return static_cast<std::uint32_t>(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void put_record(std::string& out, McapKind kind, std::string_view content) {
    out += static_cast<char>(kind);
    put(out, std::uint64_t{content.size()});
    out += content;
}

}  // namespace

McapWriter::McapWriter(const std::string& path, std::string_view topic, std::string_view type,
                       std::string_view definition, bool force)
    : file_{path, force} {
    std::string head{mcap_magic}, content;
    put_text(content, "ros2");
    put_text(content, "zlg");
    put_record(head, mcap_header, content);
    content.clear();
    put(content, number_of_one);
    put_text(content, type);
    put_text(content, "ros2msg");
    put_text(content, definition);
    put_record(summary_, mcap_schema, content);
    content.clear();
    put(content, number_of_one);
    put(content, number_of_one);
    put_text(content, topic);
    put_text(content, "cdr");
    put_text(content, "");  // nothing else is said of it
    put_record(summary_, mcap_channel, content);
    append(head);
    append(summary_);
}

void McapWriter::append(std::string_view bytes) {
    file_.append(bytes);
    size_ += bytes.size();
    crc_ = crc_of(bytes, crc_);
}

void McapWriter::write(std::uint64_t time_ns, std::string_view message) {
    if (n_messages_ == 0) first_ns_ = time_ns;
    if (chunk_.empty()) chunk_from_ns_ = time_ns;
    last_ns_ = time_ns;
    put(chunk_index_, time_ns);
    put(chunk_index_, std::uint64_t{chunk_.size()});
    std::string content;
    put(content, number_of_one);
    put(content, static_cast<std::uint32_t>(n_messages_++));
    put(content, time_ns);  // received
    put(content, time_ns);  // sent
    content += message;
    put_record(chunk_, mcap_message, content);
    if (chunk_.size() >= chunk_bytes) end_chunk();
}

void McapWriter::end_chunk() {
    if (chunk_.empty()) return;
    const std::uint64_t at = size_, n = chunk_.size();
    std::string record, content;
    put(content, chunk_from_ns_);
    put(content, last_ns_);
    put(content, n);
    put(content, crc_of(chunk_));
    put_text(content, "");  // not compressed
    put(content, n);
    content += chunk_;
    put_record(record, mcap_chunk, content);
    append(record);
    const std::uint64_t index_at = size_;
    record.clear();
    content.clear();
    put(content, number_of_one);
    put_text(content, chunk_index_);
    put_record(record, mcap_message_index, content);
    append(record);
    content.clear();
    put(content, chunk_from_ns_);
    put(content, last_ns_);
    put(content, at);
    put(content, index_at - at);
    put(content, std::uint32_t{sizeof number_of_one + sizeof index_at});
    put(content, number_of_one);
    put(content, index_at);
    put(content, size_ - index_at);
    put_text(content, "");
    put(content, n);
    put(content, n);
    put_record(summary_, mcap_chunk_index, content);
    ++n_chunks_;
    chunk_.clear();
    chunk_index_.clear();
}

std::string McapWriter::statistics() const {
    std::string content;
    put(content, n_messages_);
    put(content, std::uint16_t{1});  // types
    put(content, std::uint32_t{1});  // channels
    put(content, std::uint64_t{0});  // attachments, metadata
    put(content, n_chunks_);
    put(content, first_ns_);
    put(content, last_ns_);
    put(content, std::uint32_t{sizeof number_of_one + sizeof n_messages_});
    put(content, number_of_one);
    put(content, n_messages_);
    return content;
}

void McapWriter::close() {
    end_chunk();
    std::string end, content;
    put(content, crc_);
    put_record(end, mcap_data_end, content);
    append(end);
    const std::uint64_t begin = size_;
    put_record(summary_, mcap_statistics, statistics());
    summary_ += static_cast<char>(mcap_footer);
    put(summary_, std::uint64_t{8 + 8 + 4});
    put(summary_, begin);
    put(summary_, std::uint64_t{0});  // no offsets of groups
    put(summary_, crc_of(summary_));
    summary_ += mcap_magic;
    append(summary_);
    file_.close();
}

}  // namespace zlg::logs::bags
