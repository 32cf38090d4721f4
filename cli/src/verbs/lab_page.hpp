#pragma once
// The lab page that lies beside the program, and the links into it.

#include <string>

#include <zlg/config/config.hpp>

namespace zlg::cli {

// errors  logs::IoError where this build holds no page, or it cannot be read.
[[nodiscard]] std::string lab_page();

// The same as a server gives it: it may ask that server, and nobody else, for records.
//
// errors  as lab_page; logs::IoError where the page beside the program is not one of this version.
[[nodiscard]] std::string live_lab_page();

// The fragment of an address of the page: the settings that differ from the defaults, percent-encoded (RFC 3986), and
// `until`, to which a run of this configuration lasts.
[[nodiscard]] std::string lab_fragment(const config::Config& config, double until_s);

}  // namespace zlg::cli
