#pragma once
// What parts the columns of a text file and what the fraction, recognised together from its first lines.

#include <optional>
#include <string>
#include <vector>

#include <zlg/logs/text_columns.hpp>

#include "parted_lines.hpp"
#include "text_dialect.hpp"

namespace zlg::logs {

// How far a way of reading comes; the farthest says what is wrong.
enum class Verdict { ragged, wrong_header, broken_field, no_such_column, not_numbers, good };

struct Reading {
    Dialect dialect;
    Verdict verdict = Verdict::good;
    std::string reason;
    bool is_cut = false;  // but for the last line, which has no end
    bool names_hold_commas = false;
};

// What stands at the head of a file, below comments and lines to skip.
//
// errors  IoError, FormatError.
[[nodiscard]] FirstLines first_lines_of(const std::string& path, const TextLayout& layout);

// How columns are read.
struct Recognised {
    const Reading* reading = nullptr;  // of a Recognition
    Mark mark = Mark::none;
    bool mark_is_sure = false;
    std::vector<std::size_t> wanted;  // fields that are asked for, from 0

    [[nodiscard]] Dialect dialect() const;
};

// All ways to read the lines, from which each column that is asked for leaves one. All three must outlive it.
class Recognition {
public:
    Recognition(PartedLines& lines, const std::string& path, const TextLayout& layout);

    [[nodiscard]] const std::vector<Reading>& readings() const { return readings_; }

    // errors  as recognise_dialect(). The time is that of reading these columns.
    [[nodiscard]] Recognised of_columns(const std::vector<std::int64_t>& columns);

private:
    [[noreturn]] void refuse_ambiguous(const Reading& reading, const std::string& one, const std::string& other) const;
    [[nodiscard]] const std::string& suspicion(const Reading& reading);
    [[nodiscard]] std::string suspicion_of(const Dialect& dialect);

    PartedLines& lines_;
    const std::string& path_;
    const TextLayout& layout_;
    std::vector<Reading> readings_;
    std::vector<std::optional<std::string>> suspicions_;  // another way to read the same, in words; of each reading
};

// errors  FormatError: no way to read the lines as a table, or more than one; both are named, with the keys that
// decide.
[[nodiscard]] Dialect recognise_dialect(const FirstLines& sample, const std::string& path, const TextLayout& layout);

}  // namespace zlg::logs
