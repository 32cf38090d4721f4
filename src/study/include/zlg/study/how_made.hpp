#pragma once
// The part of a page that says how to make it again.

#include <string>
#include <string_view>

#include <zlg/config/config.hpp>
#include <zlg/report/page.hpp>

namespace zlg::study {

// Lines of TOML: the keys whose values are not the defaults.
[[nodiscard]] std::string own_settings(const config::Config& config);

// Version, seed and those settings. command: what follows `zlg`, such as "run"; inputs: what it read beside the
// configuration, or nothing.
[[nodiscard]] report::Section how_made(std::string_view command, const config::Config& config,
                                       std::string_view inputs = "");

}  // namespace zlg::study
