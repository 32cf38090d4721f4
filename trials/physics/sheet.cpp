#include <cstddef>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include <zlg/trials/physics_pictures.hpp>

#include "parts.hpp"

namespace zlg::trials {
namespace {

// Width and height of an SVG element, from its view box.
struct Size {
    double width = 0.0;
    double height = 0.0;
};

Size size_of(const std::string& element) {
    constexpr std::string_view key = "viewBox=\"0 0 ";
    const std::size_t at = element.find(key);
    if (at == std::string::npos) throw std::logic_error("a drawing without a view box");
    std::size_t used = 0;
    const std::string rest = element.substr(at + key.size(), 64);
    const double width = std::stod(rest, &used);
    return {width, std::stod(rest.substr(used))};
}

// A reader's dark mode: a dark ground, light ink, and the series in lighter shades of their colours.
constexpr std::string_view dark_mode =
    "<style>@media (prefers-color-scheme:dark){"
    "[fill=\"#fff\"]{fill:#16181b}[fill=\"#dce9f3\"]{fill:#22384a}[fill=\"#111\"],[fill=\"#222222\"],[fill=\"#444\"]{"
    "fill:#e4e6e9}"
    "[stroke=\"#444\"],[stroke=\"#222222\"]{stroke:#c4c8ce}[stroke=\"#d4d4d4\"],[stroke=\"#eee\"]{stroke:#3a3e45}"
    "[stroke=\"#0072b2\"]{stroke:#4aa8e8}[fill=\"#0072b2\"]{fill:#4aa8e8}"
    "[stroke=\"#d55e00\"]{stroke:#f39a55}[fill=\"#d55e00\"]{fill:#f39a55}"
    "[stroke=\"#009e73\"]{stroke:#3cc79c}[fill=\"#009e73\"]{fill:#3cc79c}"
    "}</style>";

}  // namespace

PhysicsPictures physics_pictures() {
    PhysicsPictures made;
    add_waves(made);
    add_bias(made);
    add_discriminator(made);
    add_field(made);
    add_lock_in(made);
    add_switch(made);
    add_piezo(made);
    add_misses(made);
    return made;
}

std::string svg_file(const Picture& picture) {
    constexpr std::string_view tag = "<svg";
    std::vector<std::string> elements;
    for (const report::Figure& figure : picture.panels) elements.push_back(report::svg(figure));
    Size sheet;
    std::string body;
    for (const std::string& element : elements) {
        const Size size = size_of(element);
        body += fmt::format("<svg y=\"{}\" height=\"{}\"{}", sheet.height, size.height, element.substr(tag.size()));
        sheet = {size.width, sheet.height + size.height};
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" "
        "width=\"{0}\" height=\"{1}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{2}\n{3}</svg>\n",
        sheet.width, sheet.height, dark_mode, body);
}

std::string markdown(const std::vector<Reading>& readings) {
    std::string out = "| quantity | value | unit |\n|---|---|---|\n";
    for (const Reading& r : readings) out += fmt::format("| {} | {} | {} |\n", r.quantity, r.value, r.unit);
    return out;
}

}  // namespace zlg::trials
