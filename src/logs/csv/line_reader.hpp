#pragma once
// Lines of a text file, one after the other, through a buffer of fixed size.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "file_descriptor.hpp"

namespace zlg::logs {

class LineReader {
public:
    // A line that does not fit is no line of a log.
    static constexpr std::size_t max_line_bytes = std::size_t{1} << 20;

    // `max_bytes` of the file, 0: any number.
    //
    // errors  IoError: no such file, a directory, no permission.
    explicit LineReader(std::string path, std::int64_t max_bytes = 0);

    // The next line without its end, which is LF, CRLF or CR, valid until the next call; false at the end of the file.
    //
    // errors  IoError; FormatError: a NUL byte, a line longer than max_line_bytes, more than max_bytes.
    bool next(std::string_view& line);

    // Nothing follows the line that was read last.
    [[nodiscard]] bool at_end();

    // The line that was read last has an end. That of a log that was cut off has none.
    [[nodiscard]] bool terminated() const { return terminated_; }
    [[nodiscard]] std::int64_t line_number() const { return line_number_; }
    [[nodiscard]] const std::string& path() const { return path_; }

    // Of the file's bytes, 0..1; 0 where a size is not known.
    [[nodiscard]] double fraction_read() const;
    // 0 where it is not known.
    [[nodiscard]] std::size_t size_bytes() const { return static_cast<std::size_t>(size_bytes_); }

private:
    void refill();
    [[nodiscard]] std::size_t find(char letter, std::size_t& found) const;
    [[nodiscard]] std::size_t find_end();
    [[nodiscard]] std::string_view take(std::size_t length);

    std::string path_;
    FileDescriptor file_;
    std::unique_ptr<char[]> buffer_;
    std::size_t begin_ = 0;    // first byte that was not handed out
    std::size_t end_ = 0;      // one past the last byte that was read
    std::size_t next_lf_ = 0;  // behind begin_; before it: not looked for
    std::size_t next_cr_ = 0;
    bool end_of_file_ = false;
    std::int64_t size_bytes_ = 0;
    std::int64_t read_bytes_ = 0;
    std::int64_t max_bytes_ = 0;
    bool terminated_ = true;
    std::int64_t line_number_ = 0;
};

}  // namespace zlg::logs
