#pragma once
// What the sinks of both logs share: rows are gathered column by column, and appended when a block is full.

#include <string>

#include "hdf5_table_writer.hpp"
#include "log_io.hpp"
#include "settings_lines.hpp"

namespace zlg::logs::hdf5 {

template <class T>
using Buffer = T*;

template <class Table>
class TableSink : public LogSink<Table> {
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
