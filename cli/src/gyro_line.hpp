#pragma once
// Settings over the line into a gyro, as docs/wire.md has it: pieces, each answered, and the check of the whole.

#include <cstdint>
#include <span>
#include <string>

namespace zlg::cli {

// errors  logs::SourceError, logs::IoError: no such line, no answer, or what the gyro objects to: its old settings
//         stay.
void load_over_line(const std::string& line, int baud, std::span<const std::uint8_t> settings);

}  // namespace zlg::cli
