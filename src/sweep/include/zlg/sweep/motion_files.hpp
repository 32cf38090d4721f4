#pragma once
// The motion files that the gyros of a sweep read: a result of one content is none of another.

#include <cstdint>
#include <string>
#include <vector>

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
    // Zero where there is no such file.
    struct Stamp {
        std::uint64_t device = 0, inode = 0;
        std::int64_t size = 0, seconds = 0, nanoseconds = 0;  // of the last writing

        friend bool operator==(const Stamp&, const Stamp&) = default;
    };
    struct Watched {
        std::string path;
        Stamp stamp;
    };

    static Stamp stamp_of(const std::string& path);

    std::vector<Watched> files_;
};

}  // namespace zlg::sweep
