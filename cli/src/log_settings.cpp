#include "log_settings.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include <zlg/core/gyro_compensation.hpp>
#include <zlg/rig/asked_compensation.hpp>

namespace zlg::cli {
namespace {

using SomeSettings = std::span<const config::Settings::value_type>;

struct Understanding {
    const Options& options;
    const std::string& log_path;
    LogSettings found;

    // Settings that can be understood together cost as much as one; where they cannot, each half is tried in turn.
    void take(SomeSettings settings) {
        std::string damage;
        if (take_all(settings, damage)) return;
        if (settings.size() == 1) {
            if (found.damage.empty()) found.damage = damage;
            return;
        }
        take(settings.first(settings.size() / 2));
        take(settings.subspan(settings.size() / 2));
    }

    // Together with what was understood before, which they may contradict.
    bool take_all(SomeSettings settings, std::string& damage) {
        config::Settings together = found.good;
        together.insert(together.end(), settings.begin(), settings.end());
        try {
            found.config = load_log_config(options, together, log_path, LogFacts::none);
            found.good = std::move(together);
            return true;
        } catch (const std::runtime_error& error) {  // FormatError; ConfigError of two keys that do not agree
            damage = error.what();
            return false;
        }
    }
};

}  // namespace

LogSettings understood(const Options& options, const config::Settings& settings, const std::string& log_path) {
    Understanding understanding{options, log_path, {}};
    understanding.take(settings);
    return std::move(understanding.found);
}

bool says(const config::Settings& settings, std::string_view fact) {
    return std::ranges::any_of(settings, [fact](const auto& setting) {
        return setting.first == fact || setting.first == fmt::format("gyro.{}", fact);
    });
}

std::optional<int> final_delay_ticks(const LogSettings& settings) {
    const auto is_bridge = [](const auto& setting) { return setting.first == "compensation.bridge"; };
    if (std::none_of(settings.good.begin(), settings.good.end(), is_bridge)) return std::nullopt;
    try {
        const core::GyroCompensationConfig made = rig::asked_compensation(settings.config);
        return core::final_delay_ticks(made.gyro, core::bridge_of(made));
    } catch (const config::ConfigError&) {
        return std::nullopt;
    }
}

}  // namespace zlg::cli
