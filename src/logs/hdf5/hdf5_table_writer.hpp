#pragma once
// A growing HDF5 file of columns: one writer, any number of readers meanwhile.

#include <cstdint>
#include <string>
#include <vector>

#include "hdf5_handle.hpp"
#include "hdf5_storage.hpp"
#include "part_file.hpp"

namespace zlg::logs::hdf5 {

// Rows that are written at once, and the length of a chunk: large enough that a call costs nothing beside the bytes.
inline constexpr std::size_t block_rows = 16384;

struct ColumnLayout {
    std::string name;    // within its group
    hid_t type;          // in memory and in the file
    const char* unit;    // attribute
    const void* buffer;  // of block_rows rows, owned by the caller
    int width = 0;       // values in a row of a two-dimensional column; 0: one-dimensional
};

// Made in three steps: objects are added, `start` opens the file for readers, rows follow.
class TableWriter {
public:
    // errors  IoError: see PartFile.
    TableWriter(const std::string& path, bool force, bool keep_part);
    ~TableWriter();
    TableWriter(TableWriter&&) = delete;

    void add_group(const std::string& path);
    void add_column(const std::string& group, const ColumnLayout& layout);
    void add_text(const std::string& path, const std::string& text);
    void set_text(const std::string& object, const char* name, const std::string& text);
    void set_real(const char* name, double value);  // of the root
    void set_integer(const char* name, std::int64_t value);
    void start();

    // How many rows the buffers take before they must be appended.
    [[nodiscard]] std::size_t room() const { return block_rows - rows_ % block_rows; }

    // Appends the first `n` rows of all buffers, and makes them visible to readers.
    //
    // errors  IoError: names PATH.part and the system's reason; what was appended before stays readable.
    void append(std::size_t n);

    [[nodiscard]] bool is_open() const { return part_.is_open(); }
    void require_open() const {
        if (!is_open()) refuse_closed();
    }
    [[nodiscard]] bool keeps_part() const { return keep_part_ && is_started_; }  // once it has rows
    [[nodiscard]] const std::string& part_path() const { return part_.part(); }

    // Closes the HDF5 file and gives it its name; without that it stays marked as not complete. errors  IoError.
    void close();

private:
    struct Column {
        Handle set;
        hid_t type;
        const void* buffer;
        hsize_t width;
    };

    [[noreturn]] void refuse_closed() const;
    void extend(const Column& column, std::size_t n);
    void check_storage();
    [[noreturn]] void fail(const char* what) const;

    PartFile part_;
    Storage storage_;
    bool keep_part_;
    bool is_started_ = false;
    hsize_t rows_ = 0;
    Handle file_;
    std::vector<Column> columns_;
};

}  // namespace zlg::logs::hdf5
