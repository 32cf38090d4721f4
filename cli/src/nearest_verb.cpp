#include "nearest_verb.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <zlg/text/spelling.hpp>

namespace zlg::cli {

std::string explain(const CLI::App& program, const CLI::ParseError& error, int argc, char** argv) {
    std::vector<std::string> verbs;
    for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; }))
        verbs.push_back(verb->get_name());
    const std::string first = argc > 1 ? argv[1] : "";
    const bool known = std::find(verbs.begin(), verbs.end(), first) != verbs.end();
    if (!known && !first.empty() && first[0] != '-') {
        const auto apart = [&](const std::string& verb) { return text::letters_apart(first, verb); };
        return fmt::format("unknown verb '{}'; did you mean '{}'? (zlg --help lists all)", first,
                           *std::ranges::min_element(verbs, {}, apart));
    }
    std::string reason = error.what();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    return fmt::format("{} (zlg {}--help lists what is allowed)", reason, known ? first + " " : "");
}

}  // namespace zlg::cli
