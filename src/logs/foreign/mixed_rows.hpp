#pragma once
// Rows of several sensors by turns.

#include <zlg/logs/imported.hpp>

namespace zlg::logs {

// errors  MappingError: a column says that the rows are of several sensors.
void refuse_mixed_rows(const ForeignLook& look);

}  // namespace zlg::logs
