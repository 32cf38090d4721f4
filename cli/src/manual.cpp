#include "manual.hpp"

#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include <zlg/config/schema.hpp>
#include <zlg/logs/table_file.hpp>

#include "help.hpp"

namespace zlg::cli {
namespace {

// Text as troff takes it: no character of it is a request.
std::string roff(std::string_view text) {
    std::string made;
    bool line_begins = true;
    for (const char c : text) {
        if (line_begins && (c == '.' || c == '\'')) made += "\\&";
        if (c == '\\')
            made += "\\e";
        else if (c == '-')
            made += "\\-";
        else
            made += c;
        line_begins = c == '\n';
    }
    return made;
}

// The page zlg(1), or zlg-VERB(1): what --help prints.
std::string man_page(const std::string& name, const CLI::App& app, const std::string& help) {
    return fmt::format(
        ".TH {0} 1 \"\" \"zlg {1}\" \"User Commands\"\n.SH NAME\n{2} \\- {3}\n.SH DESCRIPTION\n.nf\n{4}\n.fi\n"
        ".SH EXIT STATUS\n0: all is well; 1: the result is a \"no\"; 2: wrong usage or configuration; 3: input or "
        "output that is no good\n.SH SEE ALSO\n.BR zlg (1)\n",
        name, ZLG_VERSION, roff(name), roff(app.get_description()), roff(help));
}

// The long names, of options that are no secret.
std::string option_words(const CLI::App& app) {
    std::string made;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty() && !option->get_lnames().empty())
            made += fmt::format("--{} ", option->get_lnames().front());
    return made;
}

std::string bash_completion(const CLI::App& program) {
    std::string keys, verbs, cases;
    for (const config::KeyInfo& key : config::describe_keys()) keys += fmt::format("{}.{}= ", key.section, key.name);
    for (const CLI::App* verb : all_verbs(program)) {
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
                       keys, cases, verbs, option_words(program));
}

void write(const std::filesystem::path& path, const std::string& text) {
    logs::TableFile file{path, true};
    file.append(text);
    file.close();
}

void write_manual(const CLI::App& program, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder / "man1");
    write(folder / "man1" / "zlg.1", man_page("zlg", program, help_text(program, program)));
    for (const CLI::App* verb : all_verbs(program)) {
        const std::string name = "zlg-" + verb->get_name();
        write(folder / "man1" / (name + ".1"), man_page(name, *verb, help_text(program, *verb)));
    }
    write(folder / "zlg.bash", bash_completion(program));
    throw CLI::Success{};
}

}  // namespace

void add_manual(CLI::App& program) {
    const auto write_all = [&program](const std::string& folder) { write_manual(program, folder); };
    program.add_option_function<std::string>("--manual", write_all, "folder for man pages and completion")
        ->trigger_on_parse()
        ->group("");
}

}  // namespace zlg::cli
