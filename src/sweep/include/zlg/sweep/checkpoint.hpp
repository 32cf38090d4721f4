#pragma once
// RESULTS.part: the rows of a sweep that is under way, as lines of text in the order in which they came.
//
// Its first lines are the description. Each row is one line with a checksum, written by one call of the system: a
// program that is killed leaves whole lines, and at most one torn one at the end, which the next one cuts off. While a
// program writes the file, it holds a lock on it.

#include <string>

#include <zlg/sweep/results.hpp>

namespace zlg::sweep {

class Checkpoint {
public:
    // Continues the file, or begins it.
    //
    // description  of the sweep, as to_toml makes it.
    // errors       logs::IoError: it cannot be opened, another program writes it, it is of another sweep;
    //              logs::FormatError: it is no checkpoint, or damaged: file, line.
    Checkpoint(std::string path, const std::string& description);
    ~Checkpoint();
    Checkpoint(const Checkpoint&) = delete;
    Checkpoint& operator=(const Checkpoint&) = delete;

    // Those that it held when it was opened.
    [[nodiscard]] const Rows& rows() const { return rows_; }

    // From one thread at a time. errors  logs::IoError: the disk is full, or any other failure: the file holds what it
    // did before.
    void append(const Row& row);

    // The results are in their own file.
    void remove();

private:
    void begin(const std::string& description);
    void write(const std::string& text);

    std::string path_;
    int fd_ = -1;
    Rows rows_;
};

[[nodiscard]] bool is_checkpoint(const std::string& path);

// Of a file that nobody continues here. errors  as of Checkpoint, but for the lock and the other sweep.
[[nodiscard]] Results read_checkpoint(const std::string& path);

}  // namespace zlg::sweep
