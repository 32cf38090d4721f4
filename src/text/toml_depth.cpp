#include <zlg/text/toml_depth.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace zlg::text {
namespace {

// The last character of the string that begins at `at`. Where a line ends one that may not hold its end, the text is no
// TOML, as the parser will say.
std::size_t end_of_string(std::string_view toml, std::size_t at) {
    const char quote = toml[at];
    const std::string_view ends =
        toml.substr(at).starts_with(std::string(3, quote)) ? toml.substr(at, 3) : toml.substr(at, 1);
    for (at += ends.size(); at < toml.size(); ++at) {
        if (toml[at] == '\n' && ends.size() == 1) return at - 1;
        if (toml[at] == '\\' && quote == '"') {
            ++at;
        } else if (toml.substr(at).starts_with(ends)) {
            // Up to two more quotes belong to a long string.
            const std::size_t after = std::min(toml.find_first_not_of(quote, at), toml.size());
            return ends.size() == 1 ? at : std::min(after, at + 5) - 1;
        }
    }
    return at;
}

Place place_of(std::string_view toml, std::size_t at) {
    const std::string_view before = toml.substr(0, at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    return {static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(at - (before.rfind('\n') + 1) + 1)};
}

}  // namespace

// Reads TOML without understanding it: brackets, the dots of keys, and what is to be skipped.
std::optional<Place> too_deep(std::string_view toml) {
    std::array<int, max_toml_levels + 2> around{};  // levels around what each open bracket holds; first the section's
    std::size_t n_open = 0;
    int key = 0, dots = 0;  // levels of the key whose value is being read; of the key or number that is being read
    for (std::size_t at = 0; at < toml.size(); ++at) {
        switch (toml[at]) {
            case '#': at = std::min(toml.find('\n', at), toml.size()) - 1; break;
            case '"':
            case '\'': at = end_of_string(toml, at); break;
            case '.': ++dots; break;
            case '=': key = std::exchange(dots, 0) + 1; break;
            case '\n':  // a key of the outermost level is over; a value in brackets goes on
                dots = 0;
                if (n_open == 0) key = 0;
                break;
            case '[':
            case '{':
                if (n_open == 0 && key == 0) {  // of a section's name
                    around[0] = 0;
                } else {
                    around[n_open + 1] = around[n_open] + key + 1;
                    ++n_open;
                }
                key = dots = 0;
                break;
            case ']':
            case '}':
                if (n_open == 0)
                    around[0] = std::max(around[0], dots + 1);
                else
                    --n_open;
                [[fallthrough]];
            case ',': key = dots = 0; break;
            default: break;
        }
        if (around[n_open] + key + dots > max_toml_levels) return place_of(toml, at);
    }
    return std::nullopt;
}

}  // namespace zlg::text
