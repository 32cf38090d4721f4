#pragma once
// Numbers and texts put one behind the other, as `Fields` takes them.

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace zlg::logs::bags {

template <class Number>
void put(std::string& out, Number number) {
    std::array<char, sizeof number> raw;
    std::memcpy(raw.data(), &number, sizeof number);
    out.append(raw.data(), raw.size());
}

inline void put_text(std::string& out, std::string_view text) {
    put(out, static_cast<std::uint32_t>(text.size()));
    out += text;
}

}  // namespace zlg::logs::bags
