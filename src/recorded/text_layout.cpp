#include <zlg/recorded/text_layout.hpp>

namespace zlg::recorded {
namespace {

// The words of the configuration are those of the reader, in their order.
static_assert(static_cast<int>(config::TextSeparator::bar) == static_cast<int>(logs::TextSeparator::bar) &&
              static_cast<int>(config::DecimalMark::comma) == static_cast<int>(logs::TextMark::comma));

}  // namespace

logs::TextLayout text_layout(const config::Motion& motion) {
    logs::TextLayout layout;
    layout.comment = motion.comment;
    layout.skip_lines = motion.skip_lines;
    layout.separator = static_cast<logs::TextSeparator>(motion.separator);
    layout.mark = static_cast<logs::TextMark>(motion.decimal);
    layout.time_column = motion.time_column;
    layout.section = "motion";
    return layout;
}

}  // namespace zlg::recorded
