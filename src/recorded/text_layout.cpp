#include <zlg/recorded/text_layout.hpp>

namespace zlg::recorded {
namespace {

// The words of the configuration are those of the reader, in their order.
static_assert(static_cast<int>(config::TextSeparator::bar) == static_cast<int>(logs::TextSeparator::bar) &&
              static_cast<int>(config::DecimalMark::comma) == static_cast<int>(logs::TextMark::comma));

template <class Section>
logs::TextLayout layout_of(const Section& section, const char* name) {
    logs::TextLayout layout;
    layout.comment = section.comment;
    layout.skip_lines = section.skip_lines;
    layout.separator = static_cast<logs::TextSeparator>(section.separator);
    layout.mark = static_cast<logs::TextMark>(section.decimal);
    layout.time_column = section.time_column;
    layout.section = name;
    return layout;
}

}  // namespace

logs::TextLayout text_layout(const config::Analysis& analysis) { return layout_of(analysis, "analysis"); }

logs::TextLayout text_layout(const config::Motion& motion) { return layout_of(motion, "motion"); }

}  // namespace zlg::recorded
