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

}  // namespace

logs::TextLayout text_layout(const config::Motion& motion) {
    logs::TextLayout layout;
    layout.comment = motion.comment;
    layout.skip_lines = motion.skip_lines;
    layout.separator = separator_of(motion.separator);
    layout.mark = mark_of(motion.decimal);
    layout.time_column = motion.time_column;
    layout.section = "motion";
    return layout;
}

}  // namespace zlg::recorded
