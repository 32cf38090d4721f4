#include <zlg/logs/format_version.hpp>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>

namespace zlg::logs {

int checked_format_version(double value, const std::string& place) {
    for (int known = first_format_version; known <= format_version; ++known)
        if (value == known) return known;
    throw FormatError(fmt::format("{}: format_version is {}; allowed is {} to {}", place, value, first_format_version,
                                  format_version));
}

}  // namespace zlg::logs
