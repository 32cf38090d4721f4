#include <zlg/text/whole_file.hpp>

#include <fmt/format.h>

#include "open_file.hpp"

namespace zlg::text {

std::string read_whole(const std::string& path, std::size_t max_bytes) {
    OpenFile file{path};
    std::string text;
    while (file.append_to(text))
        if (text.size() > max_bytes)
            throw TooLong{fmt::format("{}: longer than {} bytes, which is the most allowed", path, max_bytes)};
    return text;
}

}  // namespace zlg::text
