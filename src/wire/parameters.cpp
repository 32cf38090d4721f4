#include <zlg/wire/parameters.hpp>

#include <limits>

#include <zlg/wire/crc.hpp>

#include "packing.hpp"
#include "parameter_places.hpp"

namespace zlg::wire {
namespace {

using enum ParameterAccess;

constexpr std::array table{
    ParameterInfo{0x0101, read_write}, ParameterInfo{0x0102, read_write}, ParameterInfo{0x0103, read_write},
    ParameterInfo{0x0104, read_write}, ParameterInfo{0x0201, read_only},  ParameterInfo{0x0202, read_only},
    ParameterInfo{0x0203, read_only},  ParameterInfo{0x0204, read_write}, ParameterInfo{0x0205, read_only},
    ParameterInfo{0x0206, read_only},  ParameterInfo{0x0207, read_write}, ParameterInfo{0x0208, read_write},
    ParameterInfo{0x0209, read_write}, ParameterInfo{0x020A, read_write}, ParameterInfo{0x020B, read_write},
    ParameterInfo{0x020C, read_write}, ParameterInfo{0x0301, read_write}, ParameterInfo{0x0302, read_write},
    ParameterInfo{0x0303, read_write}, ParameterInfo{0x0401, read_only},  ParameterInfo{0x0402, read_write},
    ParameterInfo{0x0403, read_write}, ParameterInfo{0x0404, read_write}, ParameterInfo{0x0405, read_write},
    ParameterInfo{0x0406, read_write}, ParameterInfo{0x0501, read_write}, ParameterInfo{0x0502, read_write},
    ParameterInfo{0x0503, read_write}, ParameterInfo{0x0504, read_write}, ParameterInfo{0x0505, read_write},
    ParameterInfo{0x0506, read_write}, ParameterInfo{0x0507, read_write}, ParameterInfo{0x0601, read_only},
    ParameterInfo{0x0602, read_write}, ParameterInfo{0x0603, read_write}, ParameterInfo{0x0604, read_only},
    ParameterInfo{0x0605, read_write}, ParameterInfo{0x0606, read_write}, ParameterInfo{0x0701, read_write},
    ParameterInfo{0x0702, read_write}, ParameterInfo{0x0703, read_write}, ParameterInfo{0x0704, read_write},
    ParameterInfo{0x0705, read_write}, ParameterInfo{0x0706, read_write}, ParameterInfo{0x0707, read_write},
    ParameterInfo{0x0708, read_write}, ParameterInfo{0x0709, read_write}, ParameterInfo{0x1001, read_only},
    ParameterInfo{0x1002, read_write}, ParameterInfo{0x1003, read_only},  ParameterInfo{0x1004, read_write},
    ParameterInfo{0x1005, read_write}, ParameterInfo{0x1006, read_write}, ParameterInfo{0x1007, read_write},
    ParameterInfo{0x1008, read_write}, ParameterInfo{0x1009, read_write}, ParameterInfo{0x100A, read_only},
    ParameterInfo{0x1101, read_only},  ParameterInfo{0x1102, read_only},  ParameterInfo{0x1103, read_only},
    ParameterInfo{0x1104, read_only},  ParameterInfo{0x1201, read_write}, ParameterInfo{0x1202, read_only},
    ParameterInfo{0x1301, read_only},  ParameterInfo{0x1302, read_only},  ParameterInfo{0x1303, read_only},
    ParameterInfo{0x1304, read_write},
};

const ParameterInfo* find(std::uint16_t key) noexcept {
    for (const ParameterInfo& info : table)
        if (info.key == key) return &info;
    return nullptr;
}

}  // namespace

std::span<const ParameterInfo> parameters() noexcept { return table; }

double parameter(const GyroSettings& settings, std::uint16_t key) noexcept {
    double value = std::numeric_limits<double>::quiet_NaN();
    at_places(settings, key, [&value](const auto& first, const auto&...) { value = as_number(first); });
    return value;
}

CommandResult put_parameter(GyroSettings& settings, std::uint16_t key, double value) noexcept {
    const ParameterInfo* const info = find(key);
    if (info == nullptr) return CommandResult::unknown_key;
    if (info->access == read_only) return CommandResult::read_only;
    bool fits = false;
    at_places(settings, key, [&fits, value](auto&... places) { fits = (put_number(places, value) && ...); });
    return fits ? CommandResult::done : CommandResult::not_a_value;
}

std::uint32_t settings_crc(const GyroSettings& settings) noexcept {
    static_assert(8 * table.size() <= 1024);
    std::array<std::uint8_t, 8 * table.size()> bytes{};
    for (std::size_t k = 0; k < table.size(); ++k) {
        const auto bits = std::bit_cast<std::uint64_t>(parameter(settings, table[k].key));
        for (std::size_t i = 0; i < 8; ++i) bytes[8 * k + i] = static_cast<std::uint8_t>(bits >> (8 * i));
    }
    return crc32c(bytes);
}

}  // namespace zlg::wire
