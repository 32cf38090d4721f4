#include "lab_page.hpp"

#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/text/whole_file.hpp>

#include "src/own_folder.hpp"

namespace zlg::cli {
namespace {

constexpr std::size_t longest_page = std::size_t{16} << 20;

std::string percent_encoded(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const bool plain = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
                           std::string_view{"-._~"}.find(c) != std::string_view::npos;
        out += plain ? std::string{c} : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return out;
}

}  // namespace

std::string lab_page() {
    const std::filesystem::path folder = program_folder();
    const std::filesystem::path path = (folder / "../share/zlg/lab.html").lexically_normal();
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        throw logs::IoError{fmt::format(
            "this build holds no lab page: {} is not a file; `scripts/lab` of the sources makes it", path.string())};
    try {
        return text::read_whole(path, longest_page);
    } catch (const text::CannotRead& reason) {
        throw logs::IoError{fmt::format("{}: {}", path.string(), reason.what())};
    }
}

std::string live_lab_page() {
    std::string page = lab_page();
    const auto put_after = [&page](std::string_view place, std::string_view text) {
        const std::size_t at = page.find(place);
        if (at == std::string::npos)
            throw logs::IoError{"the lab page beside this program is of another version: it shows no records"};
        page.insert(at + place.size(), text);
    };
    put_after("content=\"default-src 'none'", "; connect-src 'self'");
    // By this the page knows that it is to show records.
    put_after("<meta charset=\"utf-8\">", "\n<meta name=\"zlg-records\" content=\"records\">");
    return page;
}

std::string lab_fragment(const config::Config& config, double until_s) {
    std::string out;
    for (const auto& [key, value] : config::changed_settings(config))
        if (key != "run.duration_s") out += fmt::format("{}={}&", key, percent_encoded(value));
    return out + fmt::format("until={}", until_s);
}

}  // namespace zlg::cli
