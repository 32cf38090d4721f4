#pragma once
// What the sinks of both logs share: rows are gathered column by column, and appended when a block is full.

#include <span>
#include <string>
#include <zlg/logs/error.hpp>

#include "hdf5_fields.hpp"
#include "hdf5_table_writer.hpp"

namespace zlg::logs::hdf5 {

template <class T>
using Buffer = T*;

template <class Sink>  // RawSink or AngleSink
class TableSink : public Sink {
public:
    TableSink(const std::string& path, bool force, bool keep_part) : table_{path, force, keep_part} {}

    void flush() override { table_.flush(); }
    void close() override { table_.close(); }
    [[nodiscard]] const std::string& part_path() const override { return table_.part_path(); }

protected:
    // Columns that are not written have a buffer too: to fill it costs less than to ask for each.
    template <class Fields, class Buffers, class IsWritten>
    void add_fields(const std::string& group, std::span<const zlg::logs::Column> columns, const Fields& fields,
                    Buffers& buffers, IsWritten is_written) {
        for_each_field(fields, buffers, [&]<class T>(const auto& field, T*& rows) {
            rows = is_written(field.column) ? table_.template add_column<T>(group, columns[field.column])
                                            : table_.template add_buffer<T>();
        });
    }

    template <class Fields, class Buffers, class Row>
    void put(const Fields& fields, const Buffers& buffers, const Row& row) {
        for_each_field(fields, buffers, [&row, i = table_.row()](const auto& field, auto* rows) {
            rows[i] = std::invoke(field.member, row);
        });
    }

    TableWriter table_;
};

}  // namespace zlg::logs::hdf5
