#pragma once
// The part of a page that says how to make it again.

#include <string>
#include <string_view>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/report/page.hpp>

namespace zlg::study {

// Lines of TOML: the keys whose values are not the defaults.
[[nodiscard]] std::string own_settings(const config::Config& config);

// Version, seed and those settings. command: what follows `zlg`, such as "run".
[[nodiscard]] report::Section how_made(std::string_view command, const config::Config& config);

// Of a page that was made of files: the command as it was typed, a line of each file, the mapping (lines of TOML, or
// nothing), and the settings that are not the defaults.
[[nodiscard]] report::Section how_made(std::string_view command, const std::vector<std::string>& files,
                                       std::string_view mapping, const config::Config& config);

}  // namespace zlg::study
