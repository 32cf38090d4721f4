#pragma once
// An MCAP file of one channel: chunks as they are, with checksums, and an index behind them.

#include <cstdint>
#include <string>
#include <string_view>

#include <zlg/logs/table_file.hpp>

namespace zlg::logs::bags {

// The file appears under its name at `close`, whole, or not at all.
class McapWriter {
public:
    // `definition` of the type and of those that it is made of, as .msg of ROS 2.
    //
    // errors  IoError, as TableFile, and all that follow.
    McapWriter(const std::string& path, std::string_view topic, std::string_view type, std::string_view definition,
               bool force);

    // A message as CDR. The times may not go back.
    void write(std::uint64_t time_ns, std::string_view message);
    void close();
    [[nodiscard]] const std::string& part_path() const { return file_.part_path(); }

private:
    void append(std::string_view bytes);
    void end_chunk();
    [[nodiscard]] std::string statistics() const;

    TableFile file_;
    std::uint64_t size_ = 0;
    std::uint32_t crc_ = 0;
    std::string summary_;  // the type, the channel, and where each chunk is
    std::uint64_t n_messages_ = 0, first_ns_ = 0, last_ns_ = 0;
    std::uint32_t n_chunks_ = 0;
    std::string chunk_, chunk_index_;  // the one that is being made, and where its messages are
    std::uint64_t chunk_from_ns_ = 0;
};

}  // namespace zlg::logs::bags
