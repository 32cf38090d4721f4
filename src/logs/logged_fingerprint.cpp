#include "logged_fingerprint.hpp"

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/text/escape.hpp>

namespace zlg::logs {
namespace {

bool is_fingerprint(std::string_view text) {
    return text.size() == fingerprint_digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

}  // namespace

void require_fingerprint(const std::string& fingerprint, const std::string& place) {
    if (is_fingerprint(fingerprint)) return;
    throw FormatError(fmt::format("{}: the fingerprint is '{}'; allowed are {} hexadecimal digits", place,
                                  text::excerpt(fingerprint, 40, '?'), fingerprint_digits));
}

void refuse_fingerprint(const std::string& path) {
    throw FormatError(fmt::format("{}: has no room for a fingerprint; allowed is one with has_fingerprint", path));
}

std::string take_fingerprint(Settings& settings, const std::string& path) {
    std::string found;
    std::erase_if(settings, [&](const auto& setting) {
        if (setting.first != "fingerprint") return false;
        if (is_fingerprint(setting.second)) {
            if (!found.empty() && found != setting.second)
                throw FormatError(fmt::format("{}: fingerprint stands twice, as {} and as {}; allowed is one value",
                                              path, found, setting.second));
            found = setting.second;
        }
        return is_fingerprint(setting.second) || setting.second == no_fingerprint;
    });
    return found;
}

}  // namespace zlg::logs
