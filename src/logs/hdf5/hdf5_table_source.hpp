#pragma once
// What the sources of both logs share: blocks of rows are read, checked and handed out row by row.

#include <span>
#include <string>

#include "hdf5_table_reader.hpp"
#include "log_io.hpp"
#include "logged_fingerprint.hpp"

namespace zlg::logs::hdf5 {

template <class Table>
class TableSource : public LogSource<Table> {
public:
    bool next(typename Table::Row& row) override {
        if (n_handed_out_ == table_.block().good_rows()) {
            if (!table_.next_block([this](Block& block) { take_columns(block); })) return false;
            n_handed_out_ = 0;
        }
        for_each_column<Table>(columns_, [&row, i = n_handed_out_](const auto& field, const auto& column, std::size_t) {
            field.set(row, column.is_open() ? column[i] : field.absent);
        });
        ++n_handed_out_;
        return true;
    }

    // The row is handed out again by the next call of `next`.
    [[noreturn]] void refuse_last(std::string_view name, std::int64_t value, const std::string& what) override {
        --n_handed_out_;
        throw table_.block().complaint(n_handed_out_, fmt::format("{}/{}", Table::group, name),
                                       fmt::format("{}", value), what);
    }

    bool refresh() override {
        const bool grown = table_.refresh();
        note_completeness();
        return grown;
    }

    [[nodiscard]] double fraction_read() const override { return table_.fraction_read(); }

protected:
    TableSource(const std::string& path, std::span<const KnownColumn> known) : table_{path, Table::group, known} {
        for_each_column<Table>(columns_, [this](const auto&, auto& column, std::size_t k) { table_.open(k, column); });
    }

    // To be called when the other columns of the log are open too.
    void measure() {
        table_.measure();
        this->header_.warnings = table_.warnings();
        note_completeness();
    }

    // Reads and checks the other columns of a block.
    virtual void take_others(Block& block) = 0;

    // The place of the row that was read last in the values of a column; -1 before the first.
    [[nodiscard]] std::ptrdiff_t last_row() const { return static_cast<std::ptrdiff_t>(n_handed_out_) - 1; }

    TableReader table_;

private:
    // A fingerprint that stands already in a log without its last rows is not theirs.
    void note_completeness() {
        this->header_.complete = table_.is_complete();
        if (!this->header_.complete) return;
        this->header_.fingerprint = table_.source().text(fingerprint_path).value_or("");
        if (!this->header_.fingerprint.empty())
            require_fingerprint(this->header_.fingerprint, table_.source().path() + ", " + fingerprint_path);
    }

    void take_columns(Block& block) {
        n_handed_out_ = 0;
        for_each_column<Table>(
            columns_, [&block](const auto& field, auto& column, std::size_t) { block.take(column, field.rule); });
        take_others(block);
    }

    PartsOf<Table, Column> columns_;
    std::size_t n_handed_out_ = 0;  // rows of the block
};

}  // namespace zlg::logs::hdf5
