#include "nearest.hpp"

#include <fmt/format.h>

#include <algorithm>

#include <zlg/config/spelling.hpp>

#include "key.hpp"

namespace zlg::config {

std::string nearest_section(std::string_view section) {
    const auto apart = [&](const Key& key) { return letters_apart(section, key.section); };
    return std::string{std::ranges::min_element(all_keys(), {}, apart)->section};
}

std::string nearest_key(std::string_view section, std::string_view name) {
    // Among equals the key of the same section is meant; the right name in the wrong section is nearer than a
    // misspelling.
    const auto apart = [&](const Key& key) {
        return 2 * letters_apart(name, key.name) + (key.section == section ? 0 : 1);
    };
    const Key& nearest = *std::ranges::min_element(all_keys(), {}, apart);
    return nearest.section == section ? std::string{nearest.name}
                                      : fmt::format("[{}] {}", nearest.section, nearest.name);
}

}  // namespace zlg::config
