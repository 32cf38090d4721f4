#include <zlg/text/whole_file.hpp>

#include <fmt/format.h>

#include "open_file.hpp"

namespace zlg::text {

std::string read_whole(const std::string& path, std::size_t most_bytes) {
    OpenFile file{path};
    std::string text;
    while (file.append_to(text))
        if (text.size() > most_bytes)
            throw TooLong{fmt::format("{}: longer than {} bytes, which is the most allowed", path, most_bytes)};
    return text;
}

}  // namespace zlg::text
