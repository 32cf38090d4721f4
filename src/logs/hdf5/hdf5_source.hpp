#pragma once
// An HDF5 file that is read: finished, growing, or left behind by a writer that was killed.

#include <optional>
#include <string>
#include <vector>

#include "file_descriptor.hpp"
#include "hdf5_handle.hpp"

namespace zlg::logs::hdf5 {

// Only what lies in the file itself is read: no link or data set that leads to another file, nothing computed.
class Source {
public:
    // errors  IoError; FormatError: no HDF5, damaged, or left unfinished by a program that does not write for readers.
    explicit Source(std::string path);

    [[nodiscard]] const std::string& path() const { return path_; }
    [[nodiscard]] hid_t id() const { return file_.get(); }

    // The writer has closed the file. Read anew from the file at every call.
    [[nodiscard]] bool is_complete() const;

    // There is an object of that path. errors  FormatError: it is a link that leads elsewhere.
    [[nodiscard]] bool has(const std::string& object) const;

    // errors  FormatError: a link that leads elsewhere, more names than a log can have.
    [[nodiscard]] std::vector<std::string> members(const std::string& group) const;

    // A data set that holds one text, or an attribute of an object that does; empty where there is none.
    //
    // errors  FormatError: it holds something else, or a text of more than 16 MiB.
    [[nodiscard]] std::optional<std::string> text(const std::string& data_set) const;
    [[nodiscard]] std::optional<std::string> text_attribute(const std::string& object, const char* name) const;

    // An attribute of the root. errors  FormatError: it is no finite number; names what it is.
    [[nodiscard]] std::optional<double> real_attribute(const char* name) const;

    // errors  IoError where the system refused to read, FormatError otherwise: path, object, the library's reason.
    [[noreturn]] void fail_to_read(const std::string& object) const;
    [[noreturn]] void fail(const std::string& object, const std::string& what) const;

private:
    std::string path_;
    FileDescriptor descriptor_;
    Handle file_;
};

}  // namespace zlg::logs::hdf5
