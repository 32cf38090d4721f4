#pragma once
// What goes to standard output, whole or with an error.

#include <string_view>

namespace zlg::cli {

// errors  logs::IoError where standard output does not take it.
void print(std::string_view text);

// A bar on standard error, if that is a terminal and the work lasts over a second.
class Progress {
public:
    Progress();
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(double fraction);

private:
    bool terminal_;
    bool drawn_ = false;
    double started_s_;
    double last_s_ = 0.0;
};

}  // namespace zlg::cli
