#pragma once
// Room outside of the memory.

#include "file_descriptor.hpp"

namespace zlg::logs {

// A new file in TMPDIR, or else /tmp, that goes when it is closed; not open where none can be made.
FileDescriptor nameless_file();

}  // namespace zlg::logs
