#include <zlg/text/spelling.hpp>

#include <algorithm>
#include <numeric>
#include <vector>

namespace zlg::text {

std::size_t letters_apart(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row[b.size()];
}

std::string lower_case(std::string_view text) {
    std::string lower{text};
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

std::string small_letters(std::string_view text) {
    std::string lower = lower_case(text);
    const auto at = [&lower](std::size_t k) { return static_cast<unsigned char>(lower[k]); };
    for (std::size_t k = 0; k < lower.size(); ++k) {
        if (k + 1 == lower.size() || (at(k) != 0xC3 && at(k) != 0xD0)) continue;
        const unsigned next = at(k + 1);  // U+00C0..DE, U+0410..042F
        if (at(k) == 0xC3 ? next >= 0x80 && next <= 0x9E && next != 0x97 : next >= 0x90 && next <= 0x9F)
            lower[k + 1] = static_cast<char>(next + 0x20);
        if (at(k) == 0xD0 && next >= 0xA0 && next <= 0xAF) {
            lower[k] = '\xD1';
            lower[k + 1] = static_cast<char>(next - 0x20);
        }
        ++k;
    }
    return lower;
}

}  // namespace zlg::text
