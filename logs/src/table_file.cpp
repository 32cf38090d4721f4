#include <fmt/format.h>

#include <cerrno>
#include <zlg/logs/error.hpp>
#include <zlg/logs/table_file.hpp>

#include "part_file.hpp"

namespace zlg::logs {

namespace {

// Large enough that the system call costs nothing beside the formatting.
constexpr std::size_t block_bytes = std::size_t{1} << 20;

}  // namespace

struct TableFile::State {
    State(std::string path, bool force) : file{std::move(path), force} { buffer.reserve(2 * block_bytes); }

    // What was lost once cannot be completed: nothing appears under the name any more.
    void flush() {
        std::string_view left{buffer};
        while (!left.empty()) {
            const ssize_t n = ::write(file.fd(), left.data(), left.size());
            if (n < 0 && errno == EINTR) continue;
            if (n < 0) {
                const int error = errno;
                file.discard();
                fail_io("write", file.part(), error);
            }
            left.remove_prefix(static_cast<std::size_t>(n));
        }
        buffer.clear();
    }

    void require_open(const char* what) const {
        if (!file.is_open()) throw IoError(fmt::format("cannot {} {}: it is closed", what, file.part()));
    }

    PartFile file;
    std::string buffer;
};

TableFile::TableFile(std::string path, bool force) : state_{std::make_unique<State>(std::move(path), force)} {}
TableFile::~TableFile() = default;
TableFile::TableFile(TableFile&&) noexcept = default;
TableFile& TableFile::operator=(TableFile&&) noexcept = default;

const std::string& TableFile::part_path() const { return state_->file.part(); }

void TableFile::append(std::string_view text) {
    State& s = *state_;
    s.require_open("write");
    s.buffer += text;
    if (s.buffer.size() >= block_bytes) s.flush();
}

void TableFile::flush() {
    state_->require_open("write");
    state_->flush();
}

void TableFile::close() {
    state_->require_open("close");
    state_->flush();
    state_->file.complete();
}

}  // namespace zlg::logs
