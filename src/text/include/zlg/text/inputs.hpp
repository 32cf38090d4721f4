#pragma once
// What a program reads must never be what it writes, under whatever name.
//
// All that opens a file for reading notes it here, all that makes a file asks here, so that no verb and no pair of
// files is forgotten. A file is known by its device and inode: symbolic and hard links lead to the same one. The list
// belongs to the process, as the files do; it stays empty until a program asks for it, for a library's user may well
// write what he has read.

#include <stdexcept>
#include <string>

namespace zlg::text {

struct OutputIsInput : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// From now on inputs are noted.
void watch_inputs();

void note_input(int open_file);
void note_input(const std::string& path);  // a file that will be read later; none there: nothing

// A file that this program has made, under whatever name it stands; false where another has put its own in its place.
void note_output(int open_file);
[[nodiscard]] bool is_own_output(const std::string& path);

// errors  OutputIsInput: a file of this name is one that was noted.
void refuse_input(const std::string& output_path);

}  // namespace zlg::text
