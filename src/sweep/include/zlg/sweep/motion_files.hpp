#pragma once
// The motion files that the gyros of a sweep read: a result of one content is none of another.

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include <zlg/sweep/description.hpp>

namespace zlg::sweep {

// The description with `motion_checksums` of the files that its gyros may read, as they are now.
//
// errors  logs::IoError: a file cannot be read, is no regular file, or has another checksum than the description says.
[[nodiscard]] Description with_motion_checksums(Description description);

// The files of `motion_checksums` while gyros read them, as the system stamps them: a file that is written meanwhile is
// seen without reading it again.
class MotionWatch {
public:
    explicit MotionWatch(const Description& description);

    // Since it was made. errors  logs::IoError: one has changed.
    void require_unchanged() const;

private:
    // Device, inode, bytes, and when it was last written, s and ns; zeros where there is no such file.
    using Stamp = std::array<std::int64_t, 5>;

    static Stamp stamp_of(const std::string& path);

    std::map<std::string, Stamp> files_;
};

}  // namespace zlg::sweep
