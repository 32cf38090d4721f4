#include <zlg/report/diagram.hpp>

#include <stdexcept>
#include <string_view>

namespace zlg::report {
namespace {

// What stands between the next `opening`, up to `after` it, and `closing`.
std::string between(std::string_view text, std::string_view opening, std::string_view after, std::string_view closing) {
    const std::size_t opened = text.find(opening);
    const std::size_t begins = opened == text.npos ? opened : text.find(after, opened + opening.size());
    const std::size_t ends = begins == text.npos ? begins : text.find(closing, begins + after.size());
    if (ends == text.npos) throw std::out_of_range{"drawing without " + std::string{opening}};
    return std::string{text.substr(begins + after.size(), ends - begins - after.size())};
}

}  // namespace

Diagram diagram_of(std::string file) {
    Diagram diagram{.id = between(file, " id", "=\"", "\""),
                    .title = between(file, "<title", ">", "</title>"),
                    .caption = between(file, "<desc", ">", "</desc>")};
    diagram.file = std::move(file);
    return diagram;
}

std::string svg(const Diagram& diagram) { return diagram.file.substr(diagram.file.find("<svg")); }

}  // namespace zlg::report
