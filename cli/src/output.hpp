#pragma once
// What goes to standard output, whole or with an error; and the bar of progress on standard error. output.cpp also
// holds the functions that failure.hpp declares.

#include <string>
#include <string_view>

namespace zlg::cli {

// Then the notes that wait (failure.hpp).
//
// errors  logs::IoError where standard output does not take it.
void print(std::string_view text);

// A name of a file, or another text from outside, as a part of one line.
[[nodiscard]] std::string printable(const std::string& text);

// Without the folder.
[[nodiscard]] std::string name_of_file(const std::string& path);

// A bar with the time that is left, on standard error, if that is a terminal and the work lasts over a second. Warnings
// that wait are printed then, on a terminal or not.
class Progress {
public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(double fraction);

private:
    bool is_drawn_;  // on a terminal, and wanted
    bool drawn_ = false;
    double started_s_;
    double last_s_ = 0.0;
};

}  // namespace zlg::cli
