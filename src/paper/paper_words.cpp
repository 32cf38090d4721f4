#include "paper_words.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/args.h>

#include <zlg/paper/paper.hpp>
#include <zlg/report/number_text.hpp>

#include "paper_files.hpp"

auto fmt::formatter<zlg::paper::Shown>::format(zlg::paper::Shown shown, fmt::format_context& context) const
    -> fmt::format_context::iterator {
    using namespace zlg::report;
    const double x = shown.value;
    if (as.empty()) return fmt::format_to(context.out(), "{}", short_number(x));
    if (as.front() == '.' && as.back() == 'f') return fmt::format_to(context.out(), "{}", fixed_number(x, as[1] - '0'));
    return fmt::vformat_to(context.out(), fmt::format("{{:{}}}", as), fmt::make_format_args(x));
}

namespace zlg::paper {
namespace {

struct Entry {
    std::string name;
    std::vector<std::string> lines;
};

std::vector<std::string> split(std::string_view text, char at) {
    std::vector<std::string> parts;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t to = std::min(text.find(at, from), text.size());
        parts.emplace_back(text.substr(from, to - from));
        from = to + 1;
    }
    return parts;
}

std::vector<Entry> entries_of(std::string_view document) {
    constexpr std::string_view mark = "## ";
    std::vector<Entry> all;
    for (const std::string& line : split(document, '\n')) {
        if (line.starts_with(mark))
            all.push_back({line.substr(mark.size()), {}});
        else if (!line.empty() && !all.empty())
            all.back().lines.push_back(line);
    }
    return all;
}

const Entry& entry_of(std::string_view name) {
    static const std::vector<Entry> all = entries_of(figures_md);
    const auto found = std::ranges::find(all, name, &Entry::name);
    if (found == all.end()) throw std::logic_error{fmt::format("figures.md: there is no {}", name)};
    return *found;
}

// The lines of an entry, filled together in their order.
std::vector<std::string> lines_of(const Entry& entry, const Values& values) {
    return split(filled(fmt::format("{}", fmt::join(entry.lines, "\n")), values), '\n');
}

// The cells of a line "one | two"; an empty first one leaves nothing before its bar.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells = split(line, '|');
    for (std::string& cell : cells) {
        while (cell.ends_with(' ')) cell.pop_back();
        cell.erase(0, cell.find_first_not_of(' '));
    }
    return cells;
}

Verdict verdict_of(const std::string& name) {
    for (const Verdict v : {Verdict::agrees, Verdict::misprint, Verdict::wrong, Verdict::not_supported})
        if (name == verdict_name(v)) return v;
    throw std::logic_error{fmt::format("claims.md: {} is no verdict", name)};
}

// Of an entry: "> the claim", "**verdict**: the finding".
Claim claim_of(const Entry& entry, const Finding& finding) {
    if (entry.name != finding.where)
        throw std::logic_error{fmt::format("claims.md: {} stands where {} is due", entry.name, finding.where)};
    const std::vector<std::string> lines = lines_of(entry, finding.values);
    const std::size_t ends = lines.at(1).find("**: ");
    return {finding.where, lines[0].substr(2), verdict_of(lines[1].substr(2, ends - 2)), lines[1].substr(ends + 4)};
}

}  // namespace

std::string filled(const std::string& text, const Values& values) {
    if (std::ranges::count(text, '{') != std::ssize(values))
        throw std::logic_error{fmt::format("{} values for: {}", values.size(), text)};
    fmt::dynamic_format_arg_store<fmt::format_context> store;
    for (const Value& value : values) std::visit([&](const auto& x) { store.push_back(x); }, value);
    return fmt::vformat(text, store);
}

std::vector<std::string> words(std::string_view name, const Values& values) { return lines_of(entry_of(name), values); }

report::Figure worded(report::Figure figure, const Values& values, std::string_view name) {
    const std::vector<std::string> all = words(name.empty() ? figure.id : name, values);
    figure.title = all.at(0);
    figure.caption = all.at(1);
    figure.x_label = all.at(2);
    figure.y_label = all.at(3);
    return figure;
}

report::Table table_of(std::string_view name, std::vector<std::vector<std::string>> rows, const Values& values) {
    const std::vector<std::string> all = words(name, values);
    report::Table table{.caption = all.at(0), .header = cells_of(all.at(1))};
    for (std::size_t i = 2; i < all.size(); ++i) table.rows.push_back(cells_of(all[i]));
    table.rows.insert(table.rows.end(), rows.begin(), rows.end());
    return table;
}

PaperItem item_of(std::string number, const Values& values, std::vector<report::Table> tables,
                  std::vector<report::Figure> figures, std::string_view name) {
    std::vector<std::string> all = words(name.empty() ? number : name, values);
    report::Section section{
        .heading = all.at(0), .paragraphs = {}, .tables = std::move(tables), .figures = std::move(figures)};
    section.paragraphs.assign(all.begin() + 1, all.end());
    return {.number = std::move(number), .section = std::move(section)};
}

std::vector<Claim> claims_of(const std::vector<Finding>& findings) {
    const std::vector<Entry> entries = entries_of(claims_md);
    if (entries.size() != findings.size())
        throw std::logic_error{fmt::format("claims.md has {} claims, found are {}", entries.size(), findings.size())};
    std::vector<Claim> claims;
    for (std::size_t i = 0; i < entries.size(); ++i) claims.push_back(claim_of(entries[i], findings[i]));
    return claims;
}

}  // namespace zlg::paper
