#include "settings_lines.hpp"

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

namespace zlg::logs {

void write_settings(TableFile& file, const std::vector<std::pair<std::string, std::string>>& settings) {
    for (const auto& [key, value] : settings) {
        if ((key + value).find_first_of(std::string_view{"\n\r\0", 3}) != std::string::npos) {
            throw FormatError(fmt::format("the setting {} cannot be logged: it holds a line break or NUL", key));
        }
        file.append(fmt::format("# {} = {}\n", key, value));
    }
}

}  // namespace zlg::logs
