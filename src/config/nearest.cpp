#include "nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include <zlg/config/schema.hpp>
#include <zlg/text/spelling.hpp>

#include "key.hpp"

namespace zlg::config {
namespace {

// A name of a megabyte is no misspelling of anything.
constexpr std::size_t longest_name = 100;

std::vector<std::string_view> sections() {
    std::vector<std::string_view> names;
    for (const Key& key : all_keys())
        if (names.empty() || names.back() != key.section) names.push_back(key.section);
    return names;
}

// The key of the lowest cost, the first of equals.
template <class Cost> const Key& cheapest(const Cost& cost) {
    const auto keys = all_keys();
    return *std::min_element(keys.begin(), keys.end(), [&](const Key& a, const Key& b) { return cost(a) < cost(b); });
}

}  // namespace

std::optional<std::string_view> misspelt_section(std::string_view name) {
    static const std::vector<std::string_view> known = sections();
    if (name.size() > longest_name || std::find(known.begin(), known.end(), name) != known.end()) return std::nullopt;
    const std::string lower = text::lower_case(name);
    for (const std::string_view section : known) {
        const std::size_t longer = std::max(section.size(), lower.size());
        if (longer - std::min(section.size(), lower.size()) <= 1 && text::letters_apart(lower, section) <= 1)
            return section;
    }
    return std::nullopt;
}

std::string nearest_section(std::string_view section) {
    section = section.substr(0, longest_name);
    const auto apart = [&](const Key& key) { return text::letters_apart(section, key.section); };
    return std::string{cheapest(apart).section};
}

std::string nearest_key(std::string_view section, std::string_view name) {
    name = name.substr(0, longest_name);
    // Among equals the key of the same section is meant; the right name in the wrong section is nearer than a
    // misspelling.
    const auto apart = [&](const Key& key) {
        return 2 * text::letters_apart(name, key.name) + (key.section == section ? 0 : 1);
    };
    const Key& nearest = cheapest(apart);
    return nearest.section == section ? std::string{nearest.name}
                                      : fmt::format("[{}] {}", nearest.section, nearest.name);
}

}  // namespace zlg::config
