#pragma once
// A text file that appears under its name whole or not at all.

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace zlg::logs {

// Buffers text into PATH.part and renames it to PATH at `close`; destroyed before that, it removes PATH.part.
class TableFile {
public:
    // errors  IoError: PATH or PATH.part exists and not `force`, the folder is missing, PATH is a directory, no
    // permission.
    TableFile(std::string path, bool force);
    ~TableFile();
    TableFile(TableFile&&) noexcept;
    TableFile& operator=(TableFile&&) noexcept;

    // errors  IoError: the disk is full, or any other failure to write.
    void append(std::string_view text);

    // Puts `text` over as many bytes that were appended before, from the byte `at` of the file. errors  IoError.
    void overwrite(std::size_t at, std::string_view text);

    // Hands what was buffered to the file. errors  IoError.
    void flush();

    // Renames PATH.part to PATH; nothing can be appended after it.
    //
    // errors  IoError: the last block could not be written, or PATH has appeared meanwhile and not `force`.
    void close();

    // Whole lines appended from here on stay as PATH.part where it is not closed; without any it goes.
    void keep_what_follows();

    [[nodiscard]] const std::string& part_path() const;  // PATH.part

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace zlg::logs
