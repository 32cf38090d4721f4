#include "as_json.hpp"

#include <zlg/config/schema.hpp>

namespace zlg::cli {

nlohmann::json config_json(const config::Config& config) {
    nlohmann::json settings = nlohmann::json::object();
    for (const auto& [key, value] : config::to_settings(config)) {
        // Numbers, strings and lists are written alike in TOML and JSON, but for the rare TOML escape.
        nlohmann::json parsed = nlohmann::json::parse(value, nullptr, false);
        settings[key] = parsed.is_discarded() ? nlohmann::json(value) : std::move(parsed);
    }
    return settings;
}

std::string pretty(const nlohmann::json& value) {
    return value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace zlg::cli
