#include "foreign_file.hpp"

#include <array>
#include <string_view>

#include <fmt/format.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/file_nature.hpp>
#include <zlg/logs/text_columns.hpp>

namespace zlg::cli {
namespace {

struct Advice {
    std::string_view part;  // of the nature's name
    const char* what_to_do;
};

constexpr const char* as_text = "write its columns as text, for zlg analyze";

constexpr std::array advice_table{
    Advice{"MATLAB 5", "in MATLAB, writematrix writes its columns as text, for zlg analyze"},
    Advice{"NumPy", "numpy.savetxt writes it as text, for zlg analyze"},
    Advice{"compressed", "unpack it first"},
    Advice{"ZIP", "unpack it first, or save the table as CSV"},
    Advice{"Excel", "save the table as CSV, for zlg analyze"},
    Advice{"UTF-16", "zlg reads no other"},
    Advice{"HDF5", "a log has the group /raw or /angles (docs/logs.md)"},
};

std::string what_to_do(std::string_view nature) {
    for (const Advice& advice : advice_table)
        if (nature.find(advice.part) != std::string_view::npos) return advice.what_to_do;
    return as_text;
}

std::string names_of(const logs::TextTable& table) {
    return table.names.empty() ? "" : fmt::format(" ({})", fmt::join(table.names, ", "));
}

// The first rows are enough to see.
std::string text_file(const std::string& path) {
    try {
        const logs::TextTable table = logs::read_text_table(path, {.columns = {"1"}, .max_rows = 100});
        return fmt::format(
            "it is text with {} column{} of numbers{}, none of them named as those of a log; zlg analyze takes one "
            "with "
            "--set analysis.column=N --set analysis.column_holds=rate (or increment) --set analysis.rate_hz=...",
            table.n_columns, table.n_columns == 1 ? "" : "s", names_of(table));
    } catch (const logs::FormatError&) {
        return "no line names the columns of one";
    }
}

}  // namespace

std::string foreign_file(const std::string& path) {
    const std::string nature = logs::foreign_nature(path);
    return nature.empty() ? text_file(path) : fmt::format("it is {}; {}", nature, what_to_do(nature));
}

}  // namespace zlg::cli
