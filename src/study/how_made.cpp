#include <zlg/study/how_made.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>

namespace zlg::study {

std::string own_settings(const config::Config& config) {
    const config::Settings defaults = config::to_settings({});
    std::string text;
    for (const auto& setting : config::to_settings(config))
        if (std::ranges::find(defaults, setting) == defaults.end())
            text += fmt::format("{} = {}\n", setting.first, setting.second);
    return text;
}

report::Section how_made(std::string_view command, const config::Config& config, std::string_view inputs) {
    std::string own = own_settings(config);
    std::string text = fmt::format("zlg {}, command \"zlg {}\"", ZLG_VERSION, command);
    if (inputs.empty()) text += fmt::format(", seed {}", config.run.seed);
    text += inputs.empty() ? ". " : fmt::format(", of {}. ", inputs);
    if (own.empty()) {
        text += "All settings have their defaults.";
    } else {
        text += fmt::format(
            "All settings but those below have their defaults. Saved as made.toml, they make this page again: zlg {} "
            "--config made.toml",
            command);
        text += inputs.empty() ? "." : ", with the same files.";
    }
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
