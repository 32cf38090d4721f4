#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>

#include "manual.hpp"

namespace zlg::cli {
namespace {

std::vector<const CLI::App*> verbs_of(const CLI::App& program) {
    return program.get_subcommands([](const CLI::App*) { return true; });
}

// The long names, of options that are no secret.
std::vector<const CLI::Option*> long_options(const CLI::App& app) {
    std::vector<const CLI::Option*> made;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty() && !option->get_lnames().empty()) made.push_back(option);
    return made;
}

bool takes_value(const CLI::Option& option) { return option.get_expected_max() > 0; }

std::string key_words(std::string_view between) {
    std::string made;
    for (const config::KeyInfo& key : config::describe_keys())
        made += fmt::format("{}{}.{}=", made.empty() ? "" : between, key.section, key.name);
    return made;
}

// Text within single quotes of a shell.
std::string shell_quoted(std::string_view text) {
    std::string made = "'";
    for (const char c : text) made += c == '\'' ? std::string{"'\\''"} : std::string{c};
    return made + "'";
}

// Within the brackets of zsh's _arguments.
std::string bracketed(std::string_view text) {
    std::string made;
    for (const char c : text)
        made += c == '[' || c == ']' || c == ':' || c == '\\' ? std::string{'\\', c} : std::string{c};
    return made;
}

std::string option_words(const CLI::App& app) {
    std::string made;
    for (const CLI::Option* option : long_options(app)) made += fmt::format("--{} ", option->get_lnames().front());
    return made;
}

std::string bash_of(const CLI::App& program) {
    std::string verbs, cases;
    for (const CLI::App* verb : verbs_of(program)) {
        verbs += verb->get_name() + " ";
        cases += fmt::format("        {}) words='{}' ;;\n", verb->get_name(), option_words(*verb));
    }
    return fmt::format(R"(# Completion of zlg for bash.
_zlg() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} words
    if [ "$before" = --set ]; then
        compopt -o nospace
        COMPREPLY=($(compgen -W '{}' -- "$word"))
        return
    fi
    case ${{COMP_WORDS[1]}} in
{}        *) words='{}{}' ;;
    esac
    [[ $COMP_CWORD -gt 1 && $word != -* ]] || COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _zlg zlg
)",
                       key_words(" "), cases, verbs, option_words(program));
}

std::string zsh_arguments(const CLI::App& app) {
    std::string made;
    for (const CLI::Option* option : long_options(app)) {
        const std::string& name = option->get_lnames().front();
        const std::string value = !takes_value(*option) ? "" : name == "set" ? ":key:_zlg_keys" : ":value:_files";
        made += " \\\n                " +
                shell_quoted(fmt::format("*--{}[{}]{}", name, bracketed(option->get_description()), value));
    }
    return made + " \\\n                '*:file:_files'";
}

std::string zsh_of(const CLI::App& program) {
    std::string verbs, cases;
    for (const CLI::App* verb : verbs_of(program)) {
        verbs += "        " + shell_quoted(fmt::format("{}:{}", verb->get_name(), bracketed(verb->get_description()))) +
                 "\n";
        cases +=
            fmt::format("            {})\n                _arguments{} ;;\n", verb->get_name(), zsh_arguments(*verb));
    }
    return fmt::format(R"(#compdef zlg
# Completion of zlg for zsh.
_zlg_keys() {{
    compadd -S '' -- {}
}}
_zlg() {{
    local -a verbs=(
{}    )
    if ((CURRENT == 2)); then
        _describe verb verbs
        compadd -- {}
    else
        shift words
        ((CURRENT--))
        case $words[1] in
{}        esac
    fi
}}
_zlg "$@"
)",
                       key_words(" "), verbs, option_words(program), cases);
}

std::string fish_option(const CLI::Option& option, std::string_view condition) {
    const std::string& name = option.get_lnames().front();
    const std::string value = !takes_value(option) ? ""
                              : name == "set"      ? " -x -a " + shell_quoted(key_words(" "))
                                                   : " -r";
    return fmt::format("complete -c zlg -n {} -l {} -d {}{}\n", shell_quoted(condition), name,
                       shell_quoted(option.get_description()), value);
}

std::string fish_of(const CLI::App& program) {
    std::string made = "# Completion of zlg for fish.\n";
    for (const CLI::Option* option : long_options(program)) made += fish_option(*option, "__fish_use_subcommand");
    for (const CLI::App* verb : verbs_of(program)) {
        made += fmt::format("complete -c zlg -f -n __fish_use_subcommand -a {} -d {}\n", verb->get_name(),
                            shell_quoted(verb->get_description()));
        for (const CLI::Option* option : long_options(*verb))
            made += fish_option(*option, "__fish_seen_subcommand_from " + verb->get_name());
    }
    return made;
}

}  // namespace

std::string completion(const CLI::App& program, const std::string& shell) {
    return shell == "bash" ? bash_of(program) : shell == "zsh" ? zsh_of(program) : fish_of(program);
}

}  // namespace zlg::cli
