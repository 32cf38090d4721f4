#pragma once
// A log that is no HDF5 must be text.

#include <string>

#include <zlg/logs/file_nature.hpp>

namespace zlg::logs {

// errors  FormatError: the file is of another program; it says of which.
template <class Source>
Source open_text(const std::string& path, Source (*open)(const std::string&)) {
    refuse_foreign(path);
    return open(path);
}

}  // namespace zlg::logs
