#pragma once
// Configurations from texts, and the messages of those that are refused.

#include <zlg/config/schema.hpp>

#include "test.hpp"

namespace zlg::config {

inline Config from_toml(std::string_view text) {
    Config config;
    apply_toml(config, text, "lab.toml");
    return config;
}

inline Config with(std::initializer_list<std::string_view> settings) {
    Config config;
    for (const auto setting : settings) apply_set(config, setting);
    return config;
}

template <class Action> std::string complaint(Action action) { return test::message_of<ConfigError>(action); }

inline std::string toml_complaint(std::string_view text) {
    return complaint([&] { static_cast<void>(from_toml(text)); });
}

inline std::string set_complaint(std::string_view setting) {
    return complaint([&] { static_cast<void>(with({setting})); });
}

inline std::string check_complaint(std::initializer_list<std::string_view> settings) {
    const Config config = with(settings);
    return complaint([&] { check(config); });
}

inline void expect_contains(const std::string& text, std::string_view part) {
    EXPECT_NE(text.find(part), std::string::npos) << "in: " << text << "\nmissing: " << part;
}

// A message names the place (source or key), the value that was given and what is allowed there.
inline void expect_refused(const std::string& text, std::string_view place, std::string_view value,
                           std::string_view allowed) {
    expect_contains(text, place);
    expect_contains(text, " = " + std::string{value} + ": ");
    expect_contains(text, "allowed is " + std::string{allowed});
}

}  // namespace zlg::config
