#include <zlg/text/toml_text.hpp>

#include <fmt/format.h>

#include <cmath>

namespace zlg::text {

std::string toml_real(double value) {
    // An integer has no negative zero, so its text must show that it is a real number.
    if (value == 0.0 && std::signbit(value)) return "-0.0";
    return fmt::format("{}", value);
}

std::string toml_string(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            quoted += '\\';
            quoted += c;
        } else if (code < 0x20 || code == 0x7f) {
            quoted += fmt::format("\\u{:04X}", code);
        } else {
            quoted += c;
        }
    }
    return quoted + "\"";
}

}  // namespace zlg::text
