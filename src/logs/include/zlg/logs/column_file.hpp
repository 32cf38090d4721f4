#pragma once
// An HDF5 file of columns that are known when it is written: the results of a sweep.
//
// Equal columns make equal bytes: no times, no order of writing, no names of files are in it.

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace zlg::logs {

struct FileColumn {
    std::string name;  // without a slash
    std::string unit;  // attribute `unit`; empty where it has none
    std::variant<std::vector<std::int64_t>, std::vector<double>, std::vector<std::string>> values;
};

struct ColumnFile {
    std::string group;                                        // as "/gyros", which holds the columns
    std::vector<FileColumn> columns;                          // all of one length
    std::vector<std::pair<std::string, std::string>> texts;   // data sets of one text each, as "/sweep"
    std::vector<std::pair<std::string, std::int64_t>> marks;  // attributes of the root, up to 2^53 in size
};

// Writes PATH.new and renames it to PATH: the file is as before or whole, whatever happens. A PATH.new that is there is
// what a killed program has left. PATH may be a file that was read: who asks for it has to know (text::refuse_input).
// Texts are of fixed length and filled up with zeros, in UTF-8.
//
// errors  IoError: the disk is full, no permission, or any other failure to write: PATH is then as before.
void write_columns(const std::string& path, const ColumnFile& file);

// The columns of such a file, read one by one.
class ColumnReader {
public:
    // errors  IoError: it cannot be opened; FormatError: no HDF5, damaged.
    ColumnReader(std::string path, std::string group);
    ~ColumnReader();
    ColumnReader(ColumnReader&&) noexcept;
    ColumnReader& operator=(ColumnReader&&) noexcept;

    // errors  FormatError: there is none of this name.
    [[nodiscard]] std::string text(const std::string& name) const;
    [[nodiscard]] std::int64_t mark(const char* name) const;

    // errors  FormatError: no such column, another type, damaged; IoError.
    [[nodiscard]] std::vector<std::int64_t> integers(const std::string& name) const;
    [[nodiscard]] std::vector<double> reals(const std::string& name) const;
    [[nodiscard]] std::vector<std::string> texts(const std::string& name) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace zlg::logs
