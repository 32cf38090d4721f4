#include <zlg/report/export.hpp>

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

namespace zlg::report {
namespace {

std::string document(const std::string& element) {
    constexpr std::string_view tag = "<svg";
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\"" +
           element.substr(tag.size());
}

// A comment is one line, whatever the text.
std::string comment(std::string_view key, std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text.empty() ? "" : fmt::format("# {}: {}\n", key, text);
}

std::string rows(const Series& series) {
    const bool is_plain = series.name.find_first_of(",\"\r\n") == std::string::npos;
    const std::string name = is_plain ? series.name : csv_quoted(series.name);
    std::string out;
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
        const std::string error = i < series.y_error.size() ? fmt::format("{}", series.y_error[i]) : "";
        out += fmt::format("{},{},{},{}\n", name, series.x[i], series.y[i], error);
    }
    return out;
}

}  // namespace

std::string svg_file(const Figure& figure) { return document(svg(figure)); }
std::string svg_file(const Diagram& diagram) { return diagram.file; }

std::string csv(const Figure& figure) {
    std::string out = comment("figure", figure.title) + comment("caption", figure.caption) +
                      comment("x", figure.x_label) + comment("y", figure.y_label);
    for (const Band& band : figure.bands)
        out += comment("band", fmt::format("{} to {}, {}", band.x0, band.x1, band.name));
    out += "series,x,y,y_error\n";
    for (const Series& series : figure.series) out += rows(series);
    return out;
}

std::string csv_quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? "\"\"" : std::string{c};
    return out + "\"";
}

}  // namespace zlg::report
