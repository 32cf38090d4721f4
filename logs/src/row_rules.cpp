#include "row_rules.hpp"

#include <fmt/format.h>

namespace zlg::logs {

std::string out_of_order(std::int64_t value, std::int64_t expected) {
    return fmt::format("{}; expected {}", value > expected ? "leaves a hole" : "is a repetition", expected);
}

std::string not_alternating(std::int64_t value) {
    return fmt::format("as in the row before; expected {:+d}: it must alternate", -value);
}

std::string out_of_range(std::string_view allowed) { return fmt::format("is out of range; allowed is {}", allowed); }

std::string range(std::int64_t min, std::int64_t max) { return fmt::format("{}..{}", min, max); }

}  // namespace zlg::logs
