#pragma once
// A growing HDF5 file of columns: one writer, any number of readers meanwhile.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "hdf5_handle.hpp"
#include "hdf5_storage.hpp"
#include "log_io.hpp"
#include "part_file.hpp"
#include "settings_lines.hpp"

namespace zlg::logs::hdf5 {

// Rows that are written at once, and the length of a chunk: large enough that a call costs nothing beside the bytes.
inline constexpr std::size_t block_rows = 16384;

// Made in three steps: objects are added, `start` opens the file for readers, rows follow: each is written into the
// buffers of the columns, at row(), and ended.
class TableWriter {
    struct Column {
        Handle set;
        hid_t type;
        const void* buffer;
        hsize_t width;  // 0: one-dimensional
    };

public:
    // errors  IoError: see PartFile.
    TableWriter(const std::string& path, bool force, bool keep_part);
    ~TableWriter();
    TableWriter(TableWriter&&) = delete;

    void add_group(const std::string& path);

    // A column of T, in memory and in the file, and its buffer; `width` values in a row of a two-dimensional column.
    template <class T>
    T* add_column(const std::string& group, const char* name, const char* unit, std::size_t width = 0) {
        T* const rows = add_buffer<T>(std::max<std::size_t>(width, 1));
        add_column(fmt::format("{}/{}", group, name), unit, {{}, memory_type<T>(), rows, width});
        return rows;
    }

    // Room for block_rows rows of T, which stays as long as the writer.
    template <class T> T* add_buffer(std::size_t width = 1) {
        buffers_.push_back(std::make_unique<std::byte[]>(block_rows * width * sizeof(T)));
        return reinterpret_cast<T*>(buffers_.back().get());
    }

    void add_text(const std::string& path, const std::string& text);

    // Another text of the same length in the place of one that was added, at any time until `close`. errors  IoError.
    void overwrite_text(const std::string& path, const std::string& text);

    void set_text(const std::string& object, const char* name, const std::string& text);
    // An attribute of the root.
    void set_real(const char* name, double value) { set_number(name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &value); }
    void set_integer(const char* name, std::int64_t value) {
        set_number(name, H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
    }
    void start();

    // Where the next row belongs in the buffers.
    [[nodiscard]] std::size_t row() const { return n_; }

    // It stands there. A block that is full is flushed. errors  as flush.
    void end_row() {
        if (++n_ == room_) flush();
    }

    // Appends the rows of all buffers, and makes them visible to readers. Rows that could not be written are lost; a
    // later call fails for the same reason.
    //
    // errors  IoError: names PATH.part and the system's reason; what was appended before stays readable.
    void flush();

    [[nodiscard]] bool is_open() const { return part_.is_open(); }
    void require_open() const {
        if (!is_open()) refuse_closed();
    }
    [[nodiscard]] const std::string& part_path() const { return part_.part(); }

    // Flushes, closes the HDF5 file and gives it its name; without that it stays marked as not complete. errors
    // IoError.
    void close();

private:
    [[noreturn]] void refuse_closed() const;
    void add_column(const std::string& path, const char* unit, Column&& added);
    void set_number(const char* name, hid_t file_type, hid_t type, const void* value);
    void append(std::size_t n);
    void extend(const Column& column, std::size_t n);
    void check_storage();
    [[noreturn]] void fail(const char* what) const;

    PartFile part_;
    Storage storage_;
    bool keep_part_;
    bool is_started_ = false;
    hsize_t rows_ = 0;               // in the file
    std::size_t n_ = 0;              // in the buffers
    std::size_t room_ = block_rows;  // for so many, until the chunk is full
    Handle file_;
    std::vector<std::unique_ptr<std::byte[]>> buffers_;
    std::vector<Column> columns_;
};

// What the sinks of both logs share: rows are gathered column by column, and appended when a block is full.
template <class T> using Buffer = T*;

template <class Table> class TableSink : public LogSink<Table> {
public:
    // options  RawWriterOptions or AngleWriterOptions.
    template <class Options>
    TableSink(const std::string& path, bool force, const Options& options, const typename Table::Presence& columns)
        : table_{path, force, options.keep_part}, columns_{columns}, has_fingerprint_{options.has_fingerprint} {
        if (has_fingerprint_) table_.add_text(fingerprint_path, std::string(fingerprint_digits, '\0'));
    }

    void flush() override { table_.flush(); }
    void set_fingerprint(const std::string& fingerprint) override {
        if (!has_fingerprint_) refuse_fingerprint(part_path());
        table_.overwrite_text(fingerprint_path, fingerprint);
    }
    void close() override { table_.close(); }
    [[nodiscard]] const std::string& part_path() const override { return table_.part_path(); }

protected:
    // Columns that are not written have a buffer too: to fill it costs less than to ask for each.
    void add_columns() {
        table_.add_group(Table::group);
        for_each_column<Table>(buffers_, [this]<class T>(const auto& field, T*& rows, std::size_t) {
            rows = field.is_in(columns_) ? table_.template add_column<T>(Table::group, field.name, field.unit)
                                         : table_.template add_buffer<T>();
        });
    }

    void require_loggable(const typename Table::Row& row) const {
        table_.require_open();
        logs::require_loggable<Table>(row, columns_);
    }

    // The row still has to be ended.
    void put(const typename Table::Row& row) {
        for_each_column<Table>(buffers_, [&row, i = table_.row()](const auto& field, auto* rows, std::size_t) {
            rows[i] = field.of(row);
        });
    }

    TableWriter table_;

private:
    typename Table::Presence columns_;
    bool has_fingerprint_;
    PartsOf<Table, Buffer> buffers_{};
};

}  // namespace zlg::logs::hdf5
