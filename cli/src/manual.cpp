#include "manual.hpp"

#include <filesystem>
#include <string_view>

#include <fmt/format.h>

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

std::string upper(std::string text) {
    for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return text;
}

// An option with what it takes; of an argument the name is enough.
std::string name_and_value(const CLI::Option& option) {
    if (option.nonpositional()) {
        const bool takes_value = option.get_expected_max() > 0;
        return fmt::format("\\fB{}\\fR{}", roff(option.get_name(false, true)),
                           takes_value ? fmt::format(" \\fI{}\\fR", roff(option.get_type_name())) : "");
    }
    return fmt::format("\\fI{}\\fR", roff(option.get_name(true)));
}

std::string option_list(const CLI::App& app) {
    std::string made;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_group().empty())
            made += fmt::format(".TP\n{}\n{}\n", name_and_value(*option), roff(option->get_description()));
    return made;
}

std::string footer_of(const CLI::App& app) {
    const std::string footer = app.get_footer();
    return footer.empty() ? "" : fmt::format(".SH NOTES\n.nf\n{}\n.fi\n", roff(footer));
}

std::string head(const std::string& name, const CLI::App& app) {
    return fmt::format(".TH {} 1 \"\" \"zlg {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n", upper(name),
                       ZLG_VERSION, roff(name), roff(app.get_description()));
}

constexpr std::string_view exit_status =
    ".SH EXIT STATUS\n.TP\n0\nall is well\n.TP\n1\nthe result is a \"no\"\n"
    ".TP\n2\nwrong usage or configuration\n.TP\n3\ninput or output that is no good\n";

void write(const std::filesystem::path& path, const std::string& text) {
    logs::TableFile file{path, true};
    file.append(text);
    file.close();
}

void write_manual(const CLI::App& program, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder / "man1");
    write(folder / "man1" / "zlg.1", man_page(program));
    for (const CLI::App* verb : all_verbs(program))
        write(folder / "man1" / ("zlg-" + verb->get_name() + ".1"), man_page(program, *verb));
    for (const std::string shell : {"bash", "zsh", "fish"})
        write(folder / ("zlg." + shell), completion(program, shell));
    throw CLI::Success{};
}

}  // namespace

std::string man_page(const CLI::App& program) {
    std::string made = head("zlg", program);
    made += ".B zlg\n\\fIVERB\\fR [\\fIOPTIONS\\fR]\n.SH VERBS\n";
    for (const CLI::App* verb : all_verbs(program))
        made += fmt::format(".TP\n\\fB{}\\fR\n{}; see\n.BR zlg\\-{} (1)\n", verb->get_name(),
                            roff(verb->get_description()), verb->get_name());
    made += ".SH OPTIONS\n" + option_list(program) + std::string{exit_status} + footer_of(program);
    return made;
}

std::string man_page(const CLI::App& program, const CLI::App& verb) {
    std::string made = head("zlg-" + verb.get_name(), verb);
    made += fmt::format(".B zlg {}\n", verb.get_name());
    for (const CLI::Option* option : verb.get_options())
        if (!option->nonpositional()) made += roff(option->get_name(true)) + "\n";
    made += "[\\fIOPTIONS\\fR]\n.SH OPTIONS\n" + option_list(verb) + std::string{exit_status} + footer_of(verb);
    return made + fmt::format(".SH SEE ALSO\n.BR {} (1)\n", program.get_name());
}

void add_manual(CLI::App& program) {
    const auto write_all = [&program](const std::string& folder) { write_manual(program, folder); };
    program.add_option_function<std::string>("--manual", write_all, "folder for man pages and completions")
        ->trigger_on_parse()
        ->group("");
}

}  // namespace zlg::cli
