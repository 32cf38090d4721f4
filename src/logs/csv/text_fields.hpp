#pragma once
// Fields of a line of text, and the numbers in them.

#include <optional>
#include <string_view>
#include <vector>

namespace zlg::logs {

// What stands for "any run of blanks and tabs" among separators, which are else themselves.
inline constexpr char blanks_separator = ' ';

struct Field {
    std::string_view text;  // without the blanks and the quotes about it
    bool is_quoted = false;
};

// Splits at each separator, at most to `most` fields; what stands in quotes is one field.
void split_fields(std::string_view line, char separator, std::vector<Field>& fields,
                  std::size_t most = std::size_t(-1));

// none: a number without one, or not known.
enum class Mark : char { none = 0, point = '.', comma = ',' };

struct Number {
    double value = 0.0;
    Mark mark = Mark::none;
    bool is_grouped = false;  // 1 to 3 digits, the mark, 3 digits: the mark might part thousands
};

// A finite number with that decimal mark, with either where none is given. A comma has a digit on either side.
[[nodiscard]] std::optional<Number> number_of(std::string_view text, Mark mark);

// Empty, nan, NA, null in any case, or what another runtime writes for what is no number.
[[nodiscard]] bool says_missing(std::string_view text);

enum class FieldKind { number, missing, broken, word };

// `broken` are digits and marks that make no number and no date.
[[nodiscard]] FieldKind kind_of(const Field& field, Mark mark);

// The word could be the name of a column.
[[nodiscard]] bool may_be_name(std::string_view word);

// A whole line that is one number whose thousands are parted by `mark`, such as 1,234.5 or 1 234,5.
[[nodiscard]] bool has_parted_thousands(std::string_view line, char mark);

}  // namespace zlg::logs
