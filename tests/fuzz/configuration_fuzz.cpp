// A configuration of any text is refused with a reason and leaves the old one, or it survives being written and read.

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include <zlg/config/schema.hpp>

#include "claim.hpp"

namespace {

using namespace zlg;
using fuzz::claim;

// A configuration and its TOML, so that a refusal can be shown to have changed nothing.
struct Written {
    config::Config config;
    std::string toml = config::to_toml(config);

    // What throws anything else than a ConfigError ends the process.
    template <class Apply> bool apply(Apply to) {
        try {
            to(config);
        } catch (const config::ConfigError& error) {
            claim(!std::string_view{error.what()}.empty(), "a refusal has a reason");
            claim(config::to_toml(config) == toml, "a refusal leaves the configuration as it was");
            return false;
        }
        toml = config::to_toml(config);
        return true;
    }
};

bool is_good(const config::Config& c) {
    try {
        config::check(c);
        return true;
    } catch (const config::ConfigError&) {
        return false;
    }
}

// `start` is a configuration of defaults.
void claim_survives(const Written& written, const Written& start) {
    Written again = start;
    claim(again.apply([&](config::Config& c) { config::apply_toml(c, written.toml, "written"); }),
          "what was written is read");
    claim(again.toml == written.toml, "the TOML of a configuration is stable");
    claim(is_good(again.config) == is_good(written.config), "what is good stays good");
    Written by_log = start;
    claim(by_log.apply([&](config::Config& c) { config::apply_log(c, config::to_settings(written.config), "log"); }),
          "the settings of a configuration are read");
    claim(by_log.toml == written.toml, "settings and TOML say the same");
}

}  // namespace

// Lines that begin with `!` are settings of the command line, in their order; the rest is the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Written start;
    std::string_view text{reinterpret_cast<const char*>(data), size};
    std::string file;
    Written written = start;
    while (!text.empty()) {
        const std::size_t length = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, length);
        text.remove_prefix(std::min(length + 1, text.size()));
        if (line.starts_with('!')) {
            (void)written.apply([&](config::Config& c) { config::apply_set(c, line.substr(1)); });
        } else {
            file.append(line).append("\n");
        }
    }
    (void)written.apply([&](config::Config& c) { config::apply_toml(c, file, "fuzz.toml"); });
    claim_survives(written, start);
    return 0;
}
