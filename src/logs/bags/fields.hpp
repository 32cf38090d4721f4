#pragma once
// Numbers and texts one behind the other, little-endian, as records of bags have them: taken, and put.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "byte_stream.hpp"

namespace zlg::logs::bags {

class Fields {
public:
    explicit Fields(std::string_view bytes) : rest_{bytes} {}

    [[nodiscard]] std::size_t left() const { return rest_.size(); }

    // errors  Damaged: there are not so many.
    std::string_view bytes(std::size_t n) {
        if (n > rest_.size()) throw Damaged("a field in it goes on behind its end; allowed are whole fields");
        const std::string_view taken = rest_.substr(0, n);
        rest_.remove_prefix(n);
        return taken;
    }

    template <class Number> Number number(bool is_swapped = false) {
        std::array<char, sizeof(Number)> raw;
        std::ranges::copy(bytes(raw.size()), raw.begin());
        if (is_swapped) std::ranges::reverse(raw);
        Number value;
        std::memcpy(&value, raw.data(), raw.size());
        return value;
    }

    // Its length stands before it.
    std::string_view text() { return bytes(number<std::uint32_t>()); }

private:
    std::string_view rest_;
};

template <class Number> void put(std::string& out, Number number) {
    out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

inline void put_text(std::string& out, std::string_view text) {
    put(out, static_cast<std::uint32_t>(text.size()));
    out += text;
}

}  // namespace zlg::logs::bags
