#pragma once
// What a file is, by its content and never from its suffix.

#include <string>

namespace zlg::logs {

enum class LogKind {
    raw_csv,    // half-periods
    angle_csv,  // ticks
    raw_hdf5,
    angle_hdf5,
    unknown,  // also an empty file
};

// What is read twice, or from its end, and is waited for by nobody.
//
// errors  IoError: no such file, a folder, a pipe or a device.
void require_regular_file(const std::string& path);

// A CSV log is recognised by two or more of its column names, so that a misspelt one still gets to the reader that
// names it; an HDF5 log by its group /raw or /angles.
//
// errors  IoError: no such file, a folder, a pipe or device (it could not be read a second time), no permission;
// FormatError: an HDF5 file that is damaged or was left unfinished by a program that does not write for readers.
[[nodiscard]] LogKind recognise(const std::string& path);

// The same of a file that is no HDF5.
//
// errors  IoError: the file cannot be read.
[[nodiscard]] LogKind recognise_text(const std::string& path);

enum class LogFormat { csv, hdf5 };

// In which format an output is written: suffix .csv, .h5 or .hdf5. errors  IoError: another suffix.
[[nodiscard]] LogFormat format_of(const std::string& path);

}  // namespace zlg::logs
