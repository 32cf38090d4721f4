#include "mcap_writer.hpp"

#include <zlib.h>

#include "little_endian.hpp"
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

std::string records_of(const McapChannel& channel) {
    std::string records, content;
    put(content, number_of_one);
    put_text(content, channel.type);
    put_text(content, "ros2msg");
    put_text(content, channel.definition);
    put_record(records, mcap_schema, content);
    content.clear();
    put(content, number_of_one);
    put(content, number_of_one);
    put_text(content, channel.topic);
    put_text(content, "cdr");
    put_text(content, "");  // nothing else is said of it
    put_record(records, mcap_channel, content);
    return records;
}

}  // namespace

McapWriter::McapWriter(const std::string& path, const McapChannel& channel, bool force)
    : file_{path, force}, channel_{records_of(channel)} {
    std::string head{mcap_magic}, content;
    put_text(content, "ros2");
    put_text(content, "zlg");
    put_record(head, mcap_header, content);
    append(head);
    append(channel_);
}

void McapWriter::append(std::string_view bytes) {
    file_.append(bytes);
    size_ += bytes.size();
    crc_ = crc_of(bytes, crc_);
}

void McapWriter::write(std::uint64_t time_ns, std::string_view message) {
    entries_.push_back({time_ns, records_.size()});
    std::string content;
    put(content, number_of_one);
    put(content, static_cast<std::uint32_t>(n_messages_++));
    put(content, time_ns);  // received
    put(content, time_ns);  // sent
    content += message;
    put_record(records_, mcap_message, content);
    if (records_.size() >= chunk_bytes) end_chunk();
}

void McapWriter::end_chunk() {
    if (entries_.empty()) return;
    Chunk chunk{.first_ns = entries_.front().time_ns,
                .last_ns = entries_.back().time_ns,
                .at = size_,
                .size = 0,
                .index_size = 0,
                .n_bytes = records_.size()};
    std::string content, record;
    put(content, chunk.first_ns);
    put(content, chunk.last_ns);
    put(content, chunk.n_bytes);
    put(content, crc_of(records_));
    put_text(content, "");  // not compressed
    put(content, chunk.n_bytes);
    content += records_;
    put_record(record, mcap_chunk, content);
    append(record);
    chunk.size = record.size();
    content.clear();
    record.clear();
    put(content, number_of_one);
    put(content, static_cast<std::uint32_t>(entries_.size() * 2 * sizeof(std::uint64_t)));
    for (const Entry& entry : entries_) {
        put(content, entry.time_ns);
        put(content, entry.at);
    }
    put_record(record, mcap_message_index, content);
    append(record);
    chunk.index_size = record.size();
    chunks_.push_back(chunk);
    records_.clear();
    entries_.clear();
}

std::string McapWriter::summary() const {
    std::string records = channel_, content;
    for (const Chunk& chunk : chunks_) {
        content.clear();
        put(content, chunk.first_ns);
        put(content, chunk.last_ns);
        put(content, chunk.at);
        put(content, chunk.size);
        put(content, std::uint32_t{sizeof number_of_one + sizeof chunk.at});
        put(content, number_of_one);
        put(content, chunk.at + chunk.size);
        put(content, chunk.index_size);
        put_text(content, "");
        put(content, chunk.n_bytes);
        put(content, chunk.n_bytes);
        put_record(records, mcap_chunk_index, content);
    }
    content.clear();
    put(content, n_messages_);
    put(content, std::uint16_t{1});  // types
    put(content, std::uint32_t{1});  // channels
    put(content, std::uint64_t{0});  // attachments, metadata
    put(content, static_cast<std::uint32_t>(chunks_.size()));
    put(content, chunks_.empty() ? std::uint64_t{0} : chunks_.front().first_ns);
    put(content, chunks_.empty() ? std::uint64_t{0} : chunks_.back().last_ns);
    put(content, std::uint32_t{sizeof number_of_one + sizeof n_messages_});
    put(content, number_of_one);
    put(content, n_messages_);
    put_record(records, mcap_statistics, content);
    return records;
}

void McapWriter::close() {
    end_chunk();
    std::string end, content;
    put(content, crc_);
    put_record(end, mcap_data_end, content);
    append(end);
    const std::uint64_t begin = size_;
    std::string index = summary();
    index += static_cast<char>(mcap_footer);
    put(index, std::uint64_t{8 + 8 + 4});
    put(index, begin);
    put(index, std::uint64_t{0});  // no offsets of groups
    put(index, crc_of(index));
    index += mcap_magic;
    append(index);
    file_.close();
}

}  // namespace zlg::logs::bags
