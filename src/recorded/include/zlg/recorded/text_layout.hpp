#pragma once
// How a configuration describes a text file, for the reader of such files: all but the columns.

#include <zlg/config/config.hpp>
#include <zlg/logs/text_columns.hpp>

namespace zlg::recorded {

[[nodiscard]] logs::TextLayout text_layout(const config::Motion& motion);

}  // namespace zlg::recorded
