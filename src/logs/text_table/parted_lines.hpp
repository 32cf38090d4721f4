#pragma once
// The first lines of a file as fields, parted once in each way that is asked for.

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "text_dialect.hpp"

namespace zlg::logs {

// A row of more is no row of a table.
inline constexpr std::size_t max_fields = 100'000;

class PartedLines {
public:
    // The lines must outlive it.
    explicit PartedLines(const FirstLines& sample) : sample_{&sample} {}

    // Leaves out the first of the lines that are left.
    void skip_line() { ++skipped_; }

    [[nodiscard]] const FirstLines& sample() const { return *sample_; }
    [[nodiscard]] std::span<const Line> lines() const { return std::span{sample_->lines}.subspan(skipped_); }

    // Of each line its fields; a row has max_fields and one at most.
    [[nodiscard]] std::span<const std::vector<Field>> rows(char separator);
    [[nodiscard]] std::span<const std::vector<FieldKind>> kinds(char separator, Mark mark);

private:
    const FirstLines* sample_;
    std::size_t skipped_ = 0;
    std::map<char, std::vector<std::vector<Field>>> rows_;
    std::map<std::pair<char, Mark>, std::vector<std::vector<FieldKind>>> kinds_;
};

}  // namespace zlg::logs
