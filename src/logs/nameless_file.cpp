#include "nameless_file.hpp"

#include <atomic>
#include <cstdlib>

namespace zlg::logs {

FileDescriptor nameless_file() {
    const char* folder = std::getenv("TMPDIR");
    FileDescriptor file;
    for (int tries = 0; tries < 8 && !file.is_open(); ++tries) {
        static std::atomic<unsigned> made = 0;
        const std::string name =
            fmt::format("{}/zlg-{}-{}", folder == nullptr || *folder == 0 ? "/tmp" : folder, fmt::ptr(&file), made++);
        file = FileDescriptor{::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600)};
        if (file.is_open()) ::unlink(name.c_str());
    }
    return file;
}

}  // namespace zlg::logs
