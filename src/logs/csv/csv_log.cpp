#include <fmt/compile.h>
#include <fmt/format.h>

#include <array>
#include <zlg/logs/table_file.hpp>

#include "csv_reader.hpp"
#include "log_io.hpp"
#include "settings_lines.hpp"

namespace zlg::logs {

namespace {

void complete_header(const CsvReader&, const std::string&, AngleHeader&) {}

void complete_header(const CsvReader& csv, const std::string& path, RawHeader& header) {
    note_columns(csv, header);
    if (header.has_edge_offset) header.timer_hz = take_timer_hz(header.settings, std::nullopt, path);
}

template <class Table> class CsvSource final : public LogSource<Table> {
public:
    explicit CsvSource(const std::string& path) : csv_{path, known_columns<Table>} {
        this->header_.settings = csv_.settings();
        this->header_.fingerprint = take_fingerprint(this->header_.settings, path);
        this->header_.format_version = take_format_version(this->header_.settings, path);
        this->header_.warnings = csv_.warnings();
        complete_header(csv_, path, this->header_);
    }

    bool next(typename Table::Row& row) override {
        if (!csv_.next()) return false;
        for_each_column<Table>([&]<class Field>(const Field& field, std::size_t column) {
            using Value = typename Field::Value;
            field.set(row, csv_.has(column) ? csv_.template value<Value>(column, field.rule) : field.absent);
        });
        return true;
    }

    [[noreturn]] void refuse_last(std::string_view name, std::int64_t, const std::string& what) override {
        csv_.fail(column_named<Table>(name), what);
    }

    [[nodiscard]] bool line_is_ended() const override { return csv_.line_is_ended(); }
    [[nodiscard]] double fraction_read() const override { return csv_.fraction_read(); }

private:
    CsvReader csv_;
};

template <class Table> class CsvSink final : public LogSink<Table> {
public:
    CsvSink(const std::string& path, bool force, const Settings& settings, const typename Table::Presence& columns,
            const CsvOptions& options)
        : file_{path, force}, columns_{columns}, has_fingerprint_{options.has_fingerprint} {
        if (has_fingerprint_) file_.append(fmt::format("{}{}\n", fingerprint_line, no_fingerprint));
        if (options.format_version) file_.append(fmt::format("# {} = {}\n", version_setting, *options.format_version));
        write_settings(file_, settings);
        std::string names;
        for_each_column<Table>([&](const auto& field, std::size_t) {
            if (field.is_in(columns)) names += fmt::format("{}{}", names.empty() ? "" : ",", field.name);
        });
        file_.append(names + "\n");
        if (options.keep_part) file_.keep_what_follows();
    }

    void write(const typename Table::Row& row, const core::LightSamples&) override {
        require_loggable<Table>(row, columns_);
        constexpr std::size_t longest_number = 24;  // -2.2250738585072014e-308
        std::array<char, n_columns<Table>*(longest_number + 1)> line;
        char* end = line.data();
        for_each_column<Table>([&](const auto& field, std::size_t) {
            if (field.is_in(columns_)) end = fmt::format_to(end, FMT_COMPILE("{},"), field.of(row));
        });
        end[-1] = '\n';
        file_.append({line.data(), static_cast<std::size_t>(end - line.data())});
    }

    void flush() override { file_.flush(); }
    void set_fingerprint(const std::string& fingerprint) override {
        if (!has_fingerprint_) refuse_fingerprint(part_path());
        file_.overwrite(fingerprint_line.size(), fingerprint);
    }
    void close() override { file_.close(); }
    [[nodiscard]] const std::string& part_path() const override { return file_.part_path(); }

private:
    TableFile file_;
    typename Table::Presence columns_;
    bool has_fingerprint_;
};

}  // namespace

template <class Table> std::unique_ptr<LogSource<Table>> open_csv(const std::string& path) {
    return std::make_unique<CsvSource<Table>>(path);
}
template std::unique_ptr<LogSource<RawTable>> open_csv(const std::string&);
template std::unique_ptr<LogSource<AngleTable>> open_csv(const std::string&);

template <class Table>
std::unique_ptr<LogSink<Table>> create_csv(const std::string& path, bool force, const Settings& settings,
                                           const typename Table::Presence& columns, const CsvOptions& options) {
    return std::make_unique<CsvSink<Table>>(path, force, settings, columns, options);
}
template std::unique_ptr<LogSink<RawTable>> create_csv<RawTable>(const std::string&, bool, const Settings&,
                                                                 const RawColumns&, const CsvOptions&);
template std::unique_ptr<LogSink<AngleTable>> create_csv<AngleTable>(const std::string&, bool, const Settings&,
                                                                     const AngleTable::Presence&, const CsvOptions&);

}  // namespace zlg::logs
