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

}  // namespace

PhysicsPictures physics_pictures() {
    PhysicsPictures made;
    made.pictures.push_back(chain_picture());
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
    for (const report::Diagram& diagram : picture.diagrams) elements.push_back(report::svg(diagram));
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
        "width=\"{0}\" height=\"{1}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n{2}</svg>\n",
        sheet.width, sheet.height, body);
}

std::string markdown(const std::vector<Reading>& readings) {
    std::string out = "| quantity | value | unit |\n|---|---|---|\n";
    for (const Reading& r : readings) out += fmt::format("| {} | {} | {} |\n", r.quantity, r.value, r.unit);
    return out;
}

}  // namespace zlg::trials
