#include "hdf5_settings.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <zlg/logs/error.hpp>

#include "settings_lines.hpp"
#include "toml_settings.hpp"

namespace zlg::logs::hdf5 {

namespace {

// What a reader must know to make angles of counts stands in the root, too.
constexpr std::array<const char*, 2> root_reals{"tick_s", "scale_arcsec"};

void merge_root(const Source& source, const char* name, bool adds, Settings& settings) {
    const auto value = source.real_attribute(name);
    if (!value) return;
    const std::string* text = find_of_gyro(settings, name);
    if (text == nullptr) {
        if (adds) settings.emplace_back(fmt::format("gyro.{}", name), fmt::format("{}", *value));
        return;
    }
    const auto configured = number_in(*text);
    if (configured && *configured == *value) return;
    throw FormatError(fmt::format("{}: the attribute {} is {}, but /config says {}; allowed is one value",
                                  source.path(), name, *value, *text));
}

// A given tick_s goes before the settings' own.
void add_settings(TableWriter& table, const Settings& settings, const FormatVersion& version,
                  std::optional<double> tick_s) {
    table.add_text("/config", settings_to_toml(settings));
    if (version) table.set_integer(version_setting, *version);
    for (const char* name : root_reals) {
        if (tick_s && name == std::string_view{"tick_s"}) {
            table.set_real(name, *tick_s);
        } else if (const std::string* text = find_of_gyro(settings, name)) {
            if (const auto value = number_in(*text)) table.set_real(name, *value);
        }
    }
}

}  // namespace

void add_settings(TableWriter& table, const Settings& settings, const FormatVersion& version) {
    add_settings(table, settings, version, std::nullopt);
}

void add_angle_settings(TableWriter& table, Settings settings, const FormatVersion& version) {
    std::optional<double> tick_s;
    if (const std::string* text = find_setting(settings, "tick_s")) {
        tick_s = number_in(*text);
        if (!tick_s) throw FormatError(fmt::format("the setting tick_s is '{}'; allowed is a number", *text));
    }
    std::erase_if(settings, [](const auto& setting) { return setting.first == "flags" || setting.first == "tick_s"; });
    add_settings(table, settings, version, tick_s);
}

FormatVersion read_format_version(const Source& source) {
    const auto version = source.real_attribute(version_setting);
    if (!version) return std::nullopt;
    return checked_format_version(*version, source.path());
}

Settings read_settings(const Source& source, bool adds_tick) {
    Settings settings;
    if (const auto text = source.text("/config")) settings = settings_from_toml(*text, source.path() + ", /config");
    require_shallow_keys(settings, source.path() + ", /config");
    // What a zlg before format_version 2 of CSV logs took for notes; the attributes say it.
    std::erase_if(settings, [](const auto& setting) {
        return setting.first == version_setting || setting.first == "fingerprint";
    });
    for (const char* name : root_reals) {
        merge_root(source, name, adds_tick || name != std::string_view{"tick_s"}, settings);
    }
    return settings;
}

}  // namespace zlg::logs::hdf5
