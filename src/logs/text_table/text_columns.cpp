#include <zlg/logs/text_columns.hpp>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <string_view>
#include <zlg/logs/error.hpp>
#include <zlg/logs/file_nature.hpp>
#include <zlg/text/escape.hpp>

#include "csv/line_reader.hpp"
#include "csv/text_fields.hpp"
#include "dates.hpp"
#include "file_descriptor.hpp"
#include "text_recognition.hpp"

namespace zlg::logs {

namespace {

// The first of both ends the sample; a header and a row it has in any case.
constexpr std::size_t sample_lines = 1000;
constexpr std::size_t sample_bytes = std::size_t{1} << 20;
// Of which the comment above may name the columns.
constexpr std::size_t lines_with_comment = 64;
constexpr std::size_t longest_comment = std::size_t{1} << 16;

std::string_view without_leading_blanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first);
}

// `sep=;` above all others tells Excel the separator.
bool is_note_for_excel(std::string_view line) { return line.size() == 5 && line.starts_with("sep="); }

std::string of_windows_1251(std::string_view text) {
    std::string utf8;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        unsigned code = byte;
        if (byte >= 0xC0) code = 0x410 + byte - 0xC0;
        if (byte == 0xA8) code = 0x401;
        if (byte == 0xB8) code = 0x451;
        if (code < 0x80) {
            utf8 += c;
        } else {
            utf8 += static_cast<char>(0xC0u | (code >> 6u));
            utf8 += static_cast<char>(0x80u | (code & 0x3Fu));
        }
    }
    return utf8;
}

bool has_other_letters(std::string_view line) {
    constexpr int most = 2;
    int n = 0;
    for (const char c : line) {
        n = static_cast<unsigned char>(c) >= 0xC0 ? n + 1 : 0;
        if (n > most) return text::as_utf8(line) != line;
    }
    return false;
}

// Of a sentence such as $GPRMC,...*4A the fields.
std::string_view without_check_sum(std::string_view line) {
    if (std::string_view{"$%#"}.find(line.front()) == std::string_view::npos) return line;
    const std::size_t star = line.rfind('*');
    if (star == std::string_view::npos) return line;
    const std::size_t n_digits = line.find_last_not_of(" \t\r") - star;
    return n_digits == 2 || n_digits == 8 ? line.substr(0, star) : line;
}

// A row, by a number in it, in which that word does not stand.
bool is_of_another(std::string_view line, std::string_view word) {
    constexpr std::string_view between = " \t,;|\"";
    bool has_number = false;
    while (!line.empty()) {
        const std::size_t end = std::min(line.find_first_of(between), line.size());
        const std::string_view field = line.substr(0, end);
        if (field == word) return false;
        has_number = has_number || (!field.empty() && field.find_first_not_of("0123456789+-.eE") == std::string::npos);
        line.remove_prefix(std::min(end + 1, line.size()));
    }
    return has_number;
}

// Lines that hold rows, those at the head kept until it is known how to read them.
class DataLines {
public:
    DataLines(const std::string& path, const TextLayout& layout) : lines_{path, layout.max_bytes}, layout_{layout} {
        std::string_view line;
        std::size_t n_bytes = 0;
        while (sample_.lines.size() < 2 || (sample_.lines.size() < sample_lines && n_bytes < sample_bytes)) {
            sample_.is_whole = !next_of_file(line);
            if (sample_.is_whole) break;
            sample_.has_other_letters = sample_.has_other_letters || has_other_letters(line);
            sample_.lines.push_back({lines_.line_number(), in_utf8(line), {}});
            if (sample_.lines.size() <= lines_with_comment) sample_.lines.back().comment = comment_;
            n_bytes += line.size();
        }
        sample_.is_terminated = lines_.terminated();
    }

    [[nodiscard]] const FirstLines& sample() const { return sample_; }
    [[nodiscard]] const std::string& path() const { return lines_.path(); }
    [[nodiscard]] std::int64_t number() const { return number_; }
    [[nodiscard]] bool terminated() const { return lines_.terminated(); }

    bool next(std::string_view& line) {
        if (n_handed_out_ < sample_.lines.size()) {
            number_ = sample_.lines[n_handed_out_].number;
            line = sample_.lines[n_handed_out_++].text;
            return true;
        }
        const bool more = next_of_file(line);
        number_ = lines_.line_number();
        return more;
    }

private:
    [[nodiscard]] std::string in_utf8(std::string_view line) const {
        return layout_.is_windows_1251 ? of_windows_1251(line) : text::as_utf8(line);
    }

    bool next_of_file(std::string_view& line) {
        while (lines_.next(line)) {
            const std::string_view text = without_leading_blanks(line);
            if (text.empty() || is_note_for_excel(text)) continue;
            if (!layout_.comment.empty() && text.starts_with(layout_.comment)) {
                if (sample_.lines.size() < lines_with_comment)
                    comment_ = in_utf8(text.substr(layout_.comment.size(), longest_comment));
                if (sample_.lines.empty() && sample_.head.size() < lines_with_comment) sample_.head.push_back(comment_);
                continue;
            }
            if (n_skipped_++ < layout_.skip_lines) continue;
            line = without_check_sum(line);
            if (line.size() < text.size() && line.find(';') != std::string_view::npos) {  // behind a head of NovAtel's
                sentence_.assign(line);
                std::replace(sentence_.begin(), sentence_.end(), ';', ',');
                line = sentence_;
            }
            if (layout_.only_with.empty() || !is_of_another(text, layout_.only_with)) return true;
        }
        return false;
    }

    LineReader lines_;
    const TextLayout& layout_;
    FirstLines sample_;
    std::string comment_, sentence_;
    std::size_t n_handed_out_ = 0;
    std::int64_t n_skipped_ = 0;
    std::int64_t number_ = 0;
};

// Whether a column of integers and of numbers such as 1.234 has parted thousands, which are not read.
struct MarkUse {
    bool has_whole = false;  // of up to three digits, not 0
    bool has_grouped = false;
    bool has_other = false;  // a mark that can part no thousands

    void note(const Number& number, std::string_view text) {
        has_other = has_other || (number.mark != Mark::none && !number.is_grouped);
        has_grouped = has_grouped || number.is_grouped;
        has_whole = has_whole || (number.mark == Mark::none && text.size() <= 4 && number.value != 0.0);
    }
};

class Rows {
public:
    Rows(const std::string& path, const TextLayout& layout) : lines_{path, layout}, layout_{layout} {
        if (lines_.sample().lines.empty())
            throw FormatError(fmt::format("{}: no rows after comments and {} skipped lines", path, layout.skip_lines));
        dialect_ = recognise_dialect(lines_.sample(), path, layout);
        for (const std::size_t f : dialect_.wanted) table_.columns.push_back(column_of(f));
        if (layout.time_column > 0) table_.times = column_of(static_cast<std::size_t>(layout.time_column - 1));
        use_.resize(table_.columns.size());
    }

    TextTable read() {
        std::string_view line;
        if (dialect_.has_header) lines_.next(line);
        while (lines_.next(line)) add_row(line);
        if (table_.columns.front().values.empty())
            throw FormatError(fmt::format("{}: no rows below the header", lines_.path()));
        for (std::size_t c = 0; c < use_.size(); ++c) refuse_parted_thousands(c);
        return std::move(table_);
    }

private:
    [[nodiscard]] TextColumn column_of(std::size_t field) const {
        return {.number = static_cast<std::int64_t>(field) + 1,
                .name = field < dialect_.names.size() ? dialect_.names[field] : std::string{},
                .values = {}};
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw FormatError(fmt::format("{}:{}{}", lines_.path(), lines_.number(), why));
    }

    [[nodiscard]] std::size_t n_fields(std::string_view line) const {
        std::vector<Field> fields;
        split_fields(line, dialect_.separator, fields);
        return fields.size();
    }

    void add_row(std::string_view line) {
        if (layout_.max_rows > 0 && table_.columns.front().values.size() >= layout_.max_rows)
            refuse(fmt::format(": more than {} rows, which is the most allowed", layout_.max_rows));
        split_fields(line, dialect_.separator, fields_, dialect_.n_fields + 1);
        if (fields_.size() != dialect_.n_fields)
            refuse(fmt::format(": {} fields, where the rows above have {}{}", n_fields(line), dialect_.n_fields,
                               lines_.terminated() ? "" : "; the file may have been cut off"));
        for (std::size_t c = 0; c < table_.columns.size(); ++c)
            table_.columns[c].values.push_back(number(dialect_.wanted[c], &use_[c]));
        if (!table_.times) return;
        const auto field = static_cast<std::size_t>(table_.times->number - 1);
        const auto time = time_of(fields_[field].text);
        table_.times->values.push_back(time ? *time : number(field, nullptr));
    }

    // A date counts from the first one, for a double holds no microseconds since 1970.
    std::optional<double> time_of(std::string_view text) {
        TextColumn& times = *table_.times;
        if (!times.holds_dates)
            if (const auto number = number_of(text, dialect_.mark)) return number->value;
        if (!times.holds_dates && !times.values.empty()) return std::nullopt;
        const auto date = date_time(text);
        if (!date) return std::nullopt;
        if (!times.holds_dates) {
            times.origin = static_cast<double>(date->seconds) + date->fraction;
            times.other_origin = static_cast<double>(date->otherwise.value_or(date->seconds)) + date->fraction;
        }
        times.holds_dates = true;
        times.is_local = times.is_local || !date->has_zone;
        return dates_.since_first(*date);
    }

    double number(std::size_t field, MarkUse* use) {
        const std::string_view text = fields_[field].text;
        const auto number = number_of(text, dialect_.mark);
        if (!number) {
            if (says_missing(text)) return std::numeric_limits<double>::quiet_NaN();
            refuse(fmt::format(", column {}: '{}', allowed is a finite number, or nan where it is missing{}", field + 1,
                               text.substr(0, 60), dialect_.mark == Mark::comma ? ", with decimal commas" : ""));
        }
        if (dialect_.mark == Mark::none) dialect_.mark = number->mark;
        if (use != nullptr) use->note(*number, text);
        return number->value;
    }

    // A mark of which no number shows that it parts no thousands, and a column in which 999 and 1.234 meet.
    void refuse_parted_thousands(std::size_t c) const {
        if (layout_.mark != TextMark::automatic || dialect_.mark_is_sure || !use_[c].has_grouped) return;
        if (std::ranges::any_of(use_, &MarkUse::has_other)) return;
        // Where a comma may be the decimal mark, between semicolons or tabs, a point in every number is open as well.
        const bool may_be_german = dialect_.n_fields > 1 && (dialect_.separator == ';' || dialect_.separator == '\t');
        if (dialect_.mark != Mark::comma && !use_[c].has_whole && !may_be_german) return;
        throw FormatError(
            fmt::format("{}, {}: its numbers such as 1{}234 can be read with three decimals, or with parted thousands, "
                        "which are not read; say {}.decimal = \"{}\" for the first",
                        lines_.path(), described(table_.columns[c]), static_cast<char>(dialect_.mark), layout_.section,
                        dialect_.mark == Mark::comma ? "comma" : "point"));
    }

    DataLines lines_;
    const TextLayout& layout_;
    Dialect dialect_;
    TextTable table_;
    std::vector<MarkUse> use_;
    std::vector<Field> fields_;
    Dates dates_;
};

void check(const std::string& path, const TextLayout& layout) {
    const bool has_bad = std::ranges::any_of(layout.columns, [](std::int64_t column) { return column < 1; });
    if (layout.columns.empty() || has_bad || layout.skip_lines < 0)
        throw FormatError(
            fmt::format("{}: columns from 1 on are needed, and no negative number of lines to skip", path));
}

}  // namespace

bool ends_with_a_line(const std::string& path) {
    struct stat status {};
    // Where nothing is known of a name alone, as in the lab page, what is opened says it.
    if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)) return true;
    const FileDescriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (!file.is_open() || ::fstat(file.get(), &status) != 0 || status.st_size == 0) return true;
    char last = '\n';
    return ::pread(file.get(), &last, 1, status.st_size - 1) != 1 || last == '\n' || last == '\r';
}

std::string described(const TextColumn& column) {
    return column.name.empty() ? fmt::format("column {}", column.number)
                               : fmt::format("column {}, '{}'", column.number, column.name);
}

FirstLines first_lines_of(const std::string& path, const TextLayout& layout) {
    return DataLines{path, layout}.sample();
}

TextTable read_text_table(const std::string& path, const TextLayout& layout) {
    check(path, layout);
    refuse_foreign(path);
    return Rows{path, layout}.read();
}

std::vector<std::vector<double>> read_text_columns(const std::string& path, const TextLayout& layout) {
    std::vector<std::vector<double>> values;
    for (const TextColumn& column : read_text_table(path, layout).columns) values.push_back(column.values.vector());
    return values;
}

}  // namespace zlg::logs
