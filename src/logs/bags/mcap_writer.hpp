#pragma once
// An MCAP file of one channel: chunks as they are, with checksums, and an index behind them.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <zlg/logs/table_file.hpp>

namespace zlg::logs::bags {

struct McapChannel {
    std::string_view topic;
    std::string_view type;
    std::string_view definition;  // of the type and of those that it is made of, as .msg of ROS 2
};

// The file appears under its name at `close`, whole, or not at all.
class McapWriter {
public:
    // errors  IoError, as TableFile, and all that follow.
    McapWriter(const std::string& path, const McapChannel& channel, bool force);

    // A message as CDR. The times may not go back.
    void write(std::uint64_t time_ns, std::string_view message);
    void close();
    [[nodiscard]] const std::string& part_path() const { return file_.part_path(); }

private:
    struct Chunk {
        std::uint64_t first_ns, last_ns;
        std::uint64_t at, size, index_size, n_bytes;
    };
    struct Entry {
        std::uint64_t time_ns, at;
    };

    void append(std::string_view bytes);
    void end_chunk();
    [[nodiscard]] std::string summary() const;

    TableFile file_;
    std::string channel_;  // the records of the type and the channel
    std::uint64_t size_ = 0;
    std::uint32_t crc_ = 0;
    std::uint64_t n_messages_ = 0;
    std::string records_;         // of the chunk that is being made
    std::vector<Entry> entries_;  // of its messages
    std::vector<Chunk> chunks_;
};

}  // namespace zlg::logs::bags
