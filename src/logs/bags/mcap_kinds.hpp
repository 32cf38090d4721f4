#pragma once
// The records of MCAP, version 0: https://mcap.dev/spec.

#include <cstdint>
#include <string_view>

namespace zlg::logs::bags {

inline constexpr std::string_view mcap_magic{"\x89MCAP0\r\n", 8};

enum McapKind : std::uint8_t {
    mcap_header = 0x01,
    mcap_footer = 0x02,
    mcap_schema = 0x03,
    mcap_channel = 0x04,
    mcap_message = 0x05,
    mcap_chunk = 0x06,
    mcap_message_index = 0x07,
    mcap_chunk_index = 0x08,
    mcap_statistics = 0x0B,
    mcap_data_end = 0x0F,
    mcap_private = 0x80,  // and above: of others, not read
};

}  // namespace zlg::logs::bags
