#include <zlg/recorded/text_layout.hpp>

namespace zlg::recorded {
namespace {

logs::TextSeparator separator_of(config::TextSeparator separator) {
    switch (separator) {
        case config::TextSeparator::automatic:
            break;
        case config::TextSeparator::space:
            return logs::TextSeparator::blanks;
        case config::TextSeparator::tab:
            return logs::TextSeparator::tab;
        case config::TextSeparator::semicolon:
            return logs::TextSeparator::semicolon;
        case config::TextSeparator::comma:
            return logs::TextSeparator::comma;
        case config::TextSeparator::bar:
            return logs::TextSeparator::bar;
    }
    return logs::TextSeparator::automatic;
}

logs::TextMark mark_of(config::DecimalMark mark) {
    switch (mark) {
        case config::DecimalMark::automatic:
            break;
        case config::DecimalMark::point:
            return logs::TextMark::point;
        case config::DecimalMark::comma:
            return logs::TextMark::comma;
    }
    return logs::TextMark::automatic;
}

template <class Section>
logs::TextLayout layout_of(const Section& section, const char* name) {
    logs::TextLayout layout;
    layout.comment = section.comment;
    layout.skip_lines = section.skip_lines;
    layout.separator = separator_of(section.separator);
    layout.mark = mark_of(section.decimal);
    layout.time_column = section.time_column;
    layout.section = name;
    return layout;
}

}  // namespace

logs::TextLayout text_layout(const config::Analysis& analysis) { return layout_of(analysis, "analysis"); }

logs::TextLayout text_layout(const config::Motion& motion) { return layout_of(motion, "motion"); }

}  // namespace zlg::recorded
