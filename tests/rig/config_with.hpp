#pragma once
// The default configuration with some settings.

#include <zlg/config/config.hpp>
#include <zlg/config/schema.hpp>

#include "test.hpp"

namespace zlg::test {

inline config::Config config_with(std::initializer_list<std::string_view> settings) {
    config::Config c;
    for (const auto setting : settings) config::apply_set(c, setting);
    return c;
}

}  // namespace zlg::test
