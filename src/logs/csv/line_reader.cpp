#include "line_reader.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <zlg/logs/error.hpp>
#include <zlg/text/inputs.hpp>

namespace zlg::logs {

namespace {

// Spreadsheets put it before UTF-8 text.
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

}  // namespace

LineReader::LineReader(std::string path, std::int64_t max_bytes)
    : path_{std::move(path)}, file_{open_to_read(path_)}, buffer_{new char[max_line_bytes]}, max_bytes_{max_bytes} {
    text::note_input(file_.get());
    struct stat status {};
    if (::fstat(file_.get(), &status) == 0) size_bytes_ = status.st_size;
    refill();
    if (std::string_view{buffer_.get(), end_}.starts_with(byte_order_mark)) begin_ = byte_order_mark.size();
}

void LineReader::refill() {
    std::memmove(buffer_.get(), buffer_.get() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = next_lf_ = next_cr_ = 0;
    while (!end_of_file_ && end_ < max_line_bytes) {
        const ssize_t n = ::read(file_.get(), buffer_.get() + end_, max_line_bytes - end_);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) fail_io("read", path_, errno);
        end_of_file_ = n == 0;
        end_ += static_cast<std::size_t>(n);
        read_bytes_ += n;
        if (max_bytes_ > 0 && read_bytes_ > max_bytes_)
            throw FormatError(fmt::format("{}: more than {} bytes, which is the most allowed", path_, max_bytes_));
    }
}

double LineReader::fraction_read() const {
    return size_bytes_ > 0 ? static_cast<double>(read_bytes_) / static_cast<double>(size_bytes_) : 0.0;
}

bool LineReader::at_end() {
    if (begin_ == end_ && !end_of_file_) refill();
    return begin_ == end_;
}

// Looked for once: the place of the next such letter, end_ where there is none.
std::size_t LineReader::find(char letter, std::size_t& found) const {
    if (begin_ == end_) return end_;
    if (found > begin_) return found;
    const void* at = std::memchr(buffer_.get() + begin_, letter, end_ - begin_);
    found = at == nullptr ? end_ : static_cast<std::size_t>(static_cast<const char*>(at) - buffer_.get());
    return found;
}

// Behind the line: LF, with up to two CRs before it that belong to it, or a CR.
std::size_t LineReader::find_end() {
    const std::size_t lf = find('\n', next_lf_), cr = find('\r', next_cr_);
    if (cr >= lf) return lf;
    if (cr + 2 >= end_ && !end_of_file_) return end_;  // what follows decides
    const bool belongs = lf < end_ && lf - cr <= 2 && buffer_[lf - 1] == '\r';
    return belongs ? lf : cr;
}

std::string_view LineReader::take(std::size_t length) {
    std::string_view line{buffer_.get() + begin_, length};
    begin_ += length + (terminated_ ? 1 : 0);
    ++line_number_;
    if (line.find('\0') != std::string_view::npos) {
        throw FormatError(fmt::format("{}:{}: a NUL byte; this is not a text file", path_, line_number_));
    }
    while (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

bool LineReader::next(std::string_view& line) {
    std::size_t stop = find_end();
    if (stop == end_ && !end_of_file_) {
        refill();
        stop = find_end();
    }
    if (begin_ == end_) return false;
    if (stop == end_ && !end_of_file_) {
        throw FormatError(fmt::format("{}:{}: a line of more than {} bytes; this is not a log", path_, line_number_ + 1,
                                      max_line_bytes));
    }
    terminated_ = stop < end_;
    line = take(stop - begin_);
    return true;
}

}  // namespace zlg::logs
