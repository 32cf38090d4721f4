#pragma once
// What a mapping says of the columns of a raw log: columns of the foreign file, or a value in their place.

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <zlg/logs/imported.hpp>

namespace zlg::logs {

inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

struct RawSource {
    std::string key;
    LongColumn values;   // of a column; empty: `fixed`
    double fixed = 0.0;  // NaN: of a column
    bool alternates = false;
    std::string from;  // for messages
};

// A column of two values becomes one of +1 and -1: `plus` is the one that stands for +1, unset: they stand so.
// `where` and `key` for messages.
//
// errors  MappingError, FormatError: another value.
void make_signs(LongColumn& values, std::optional<double> plus, const std::string& where, const std::string& key);

class RawSources {
public:
    // Reads the columns. errors  as imported_raw().
    explicit RawSources(const ForeignLook& look);

    // Null where the mapping has nothing of that key.
    [[nodiscard]] const RawSource* find(std::string_view key) const;
    [[nodiscard]] const TextTable& read() const { return read_; }
    [[nodiscard]] std::size_t n() const { return n_; }
    // Of what was understood of the times.
    [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }
    [[nodiscard]] bool is_column(std::string_view key) const {
        const RawSource* source = find(key);
        return source != nullptr && !source->values.empty();
    }

    // In row k, which decides of what alternates. NaN in a row that is missing, and where there is nothing of that key.
    [[nodiscard]] double at(std::string_view key, std::size_t k) const;

    // Puts rows where some are missing.
    void fill(const RowTimes& times);

    // Of row k as filled the number in the file, from 1.
    [[nodiscard]] std::size_t row_of_file(std::size_t k) const;

    // errors  FormatError, always: path, column, row, value, what is allowed.
    [[noreturn]] void refuse(std::string_view key, std::size_t k, const std::string& allowed) const;

private:
    void refuse_empty_states() const;
    void refuse_other_counts() const;

    const ForeignLook& look_;
    std::vector<RawSource> all_;
    TextTable read_;
    std::vector<std::string> notes_;
    std::vector<Hole> holes_;
    std::size_t n_ = 0;
};

}  // namespace zlg::logs
