#pragma once
// Bytes from a file, a pipe, a serial device or a socket, without an end of their own where the source has none.

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

namespace zlg::logs {

// A source that cannot be meant: an address or a speed that is none.
struct SourceError : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

class ByteSource {
public:
    // source  a path, `-` for standard input, `tcp:HOST:PORT` or `unix:PATH`.
    // baud    of a serial device, which is set to eight bits without parity and to nothing else that would change a
    // byte.
    //
    // errors  SourceError: a speed that no serial device has, a malformed address; IoError: it cannot be opened.
    // access  `both`: bytes are also sent, which a file and standard input cannot take.
    enum class Access { read, both };
    ByteSource(const std::string& source, int baud, Access access = Access::read);
    ~ByteSource();
    ByteSource(const ByteSource&) = delete;
    ByteSource& operator=(const ByteSource&) = delete;

    enum class Read { bytes, nothing, end };

    // Wait up to `patience_ms` for bytes; `n` of them are in `buffer`.
    //
    // errors  IoError.
    [[nodiscard]] Read read(std::span<std::uint8_t> buffer, std::size_t& n, int patience_ms);

    // Send all of them.
    //
    // errors  IoError, also where the other end has taken nothing for two seconds.
    void write(std::span<const std::uint8_t> bytes);

private:
    std::string name_;
    int fd_ = -1;
    bool owned_ = true;
};

}  // namespace zlg::logs
