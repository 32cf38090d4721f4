#include "parted_lines.hpp"

#include <algorithm>
#include <iterator>

namespace zlg::logs {

std::span<const std::vector<Field>> PartedLines::rows(char separator) {
    auto& rows = rows_[separator];
    if (rows.empty()) {
        rows.resize(sample_->lines.size());
        for (std::size_t k = 0; k < rows.size(); ++k)
            split_fields(sample_->lines[k].text, separator, rows[k], max_fields + 1);
    }
    return std::span{rows}.subspan(skipped_);
}

std::span<const std::vector<FieldKind>> PartedLines::kinds(char separator, Mark mark) {
    (void)rows(separator);
    auto& kinds = kinds_[{separator, mark}];
    if (kinds.empty())
        for (const std::vector<Field>& row : rows_[separator])
            std::transform(row.begin(), row.end(), std::back_inserter(kinds.emplace_back()),
                           [mark](const Field& field) { return kind_of(field, mark); });
    return std::span{kinds}.subspan(skipped_);
}

}  // namespace zlg::logs
