#pragma once
// The motion files that the gyros of a sweep read: a result of one content is none of another.

#include <zlg/sweep/description.hpp>

namespace zlg::sweep {

// The description with `motion_checksums` of the files that its gyros may read, as they are now.
//
// errors  logs::IoError: a file cannot be read, is no regular file, or has another checksum than the description says.
[[nodiscard]] Description with_motion_checksums(Description description);

}  // namespace zlg::sweep
