#pragma once
// How far a misspelt word is from the one that was meant.

#include <cstddef>
#include <string>
#include <string_view>

namespace zlg::text {

// The least number of letters to insert, delete or replace that makes one word of the other (Levenshtein).
[[nodiscard]] std::size_t letters_apart(std::string_view a, std::string_view b);

// The letters A to Z as a to z.
[[nodiscard]] std::string lower_case(std::string_view text);

// With small letters in place of capitals: of ASCII, and of Latin-1 and Russian in UTF-8.
[[nodiscard]] std::string small_letters(std::string_view text);

}  // namespace zlg::text
