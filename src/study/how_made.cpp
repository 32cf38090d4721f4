#include <zlg/study/how_made.hpp>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>

namespace zlg::study {

std::string own_settings(const config::Config& config) {
    std::string text;
    for (const auto& [key, value] : config::changed_settings(config)) text += fmt::format("{} = {}\n", key, value);
    return text;
}

report::Section how_made(std::string_view command, const config::Config& config) {
    std::string own = own_settings(config);
    std::string text = fmt::format("zlg {}, command \"zlg {}\", seed {}. ", ZLG_VERSION, command, config.run.seed);
    text += own.empty()
                ? "All settings have their defaults."
                : fmt::format(
                      "All settings but those below have their defaults. Saved as made.toml, they make this page "
                      "again: zlg {} --config made.toml.",
                      command);
    return {.heading = "How this page was made",
            .paragraphs = {std::move(text)},
            .code = std::move(own),
            .is_of_page = true};
}

report::Section how_made(std::string_view command, const std::vector<std::string>& files, std::string_view mapping,
                         const config::Config& config) {
    std::string code = fmt::format("{}\n", command);
    for (const std::string& file : files) code += fmt::format("# {}\n", file);
    if (!mapping.empty()) code += fmt::format("\n# what the mapping says\n{}", mapping);
    if (const std::string own = own_settings(config); !own.empty())
        code += fmt::format("\n# settings that are not the defaults, those of the log among them\n{}", own);
    return {.heading = "How this page was made",
            .paragraphs = {fmt::format("zlg {}, by this command, of these files.", ZLG_VERSION)},
            .code = std::move(code),
            .is_of_page = true};
}

}  // namespace zlg::study
