#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <zlg/config/schema.hpp>
#include <zlg/text/toml_text.hpp>

#include "key.hpp"

namespace zlg::config {

namespace {

template <class... F> struct Overload : F... { using F::operator()...; };
template <class... F> Overload(F...) -> Overload<F...>;

// One element stands alone.
template <class Element, class ToText>
std::string list_text(const std::vector<Element>& elements, const ToText& text_of) {
    std::string text;
    for (const Element& each : elements) text += (text.empty() ? "" : ", ") + text_of(each);
    return elements.size() == 1 ? text : "[" + text + "]";
}

std::string points_text(const Course& course) {
    if (!course.path.empty()) return text::toml_string(course.path);
    std::string text;
    for (const twin::CoursePoint& point : course.points)
        text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", text::toml_real(point.at_s),
                            text::toml_real(point.value));
    return text.empty() ? text : "[" + text + "]";
}

std::string interval_text(const Switching& switching) {
    return switching.interval_optimal ? text::toml_string("optimal") : text::toml_real(switching.interval_s);
}

// An enumerator that code has made of a number has no name.
std::string name_text(std::span<const std::string_view> names, int index) {
    const auto k = static_cast<std::size_t>(index);
    return k < names.size() ? text::toml_string(names[k]) : "no name";
}

std::string choice_text(const Choice& slot, const Config& config) {
    const int index = slot.get(config);
    return index < 0 ? std::string{} : name_text(slot.names, index);
}

std::string choices_text(const ChoiceList& slot, const Config& config) {
    const std::vector<int> indices = slot.get(config);
    if (indices.empty()) return {};
    return list_text(indices, [&](int index) { return name_text(slot.names, index); });
}

bool is_number(const std::string& column) {
    const std::size_t sign = column.starts_with('-') ? 1 : 0;
    return column.size() > sign && column.find_first_not_of("0123456789", sign) == std::string::npos;
}

// Of one that is set: a number from 1 (or 0) to a million, or any name.
bool is_column(const std::string& column, bool may_be_none) {
    if (column.empty()) return false;
    if (!is_number(column)) return true;
    const bool none = column.find_first_not_of('0') == std::string::npos;
    return !column.starts_with('-') && column.size() <= 7 && (none ? may_be_none : std::stoll(column) <= 1'000'000);
}

std::string column_text(const std::string& column) {
    return column.empty() || is_number(column) ? column : text::toml_string(column);
}

bool is_within(const Slot& slot, const Config& config) {
    return std::visit(
        Overload{[&](const Real& s) { return contains(s.range, s.value(config)); },
                 [&](const OptionalReal& s) { return !s.value(config) || contains(s.range, *s.value(config)); },
                 [&](const Integer& s) { return contains(s, s.get(config)); }, [&](const Text&) { return true; },
                 [&](const RealList& s) {
                     const std::vector<double>& all = s.value(config);
                     return (s.may_be_empty || !all.empty()) &&
                            std::all_of(all.begin(), all.end(), [&](double value) { return contains(s.range, value); });
                 },
                 [&](const ChoiceList& s) {
                     const auto chosen = s.get(config);
                     return std::all_of(chosen.begin(), chosen.end(),
                                        [&](int i) { return i >= 0 && i < static_cast<int>(s.names.size()); });
                 },
                 [&](const Interval& s) {
                     return config.switching.interval_optimal || contains(s.range, config.switching.interval_s);
                 },
                 [&](const Choice& s) { return s.get(config) < static_cast<int>(s.names.size()); },
                 [&](const Points&) { return true; },
                 [&](const Column& s) { return s.value(config).empty() || is_column(s.value(config), s.may_be_none); }},
        slot);
}

}  // namespace

std::string dotted(const Key& key) { return fmt::format("{}.{}", key.section, key.name); }

std::string value_text(const Key& key, const Config& config) {
    return std::visit(Overload{[&](const Real& s) { return text::toml_real(s.value(config)); },
                               [&](const OptionalReal& s) {
                                   return s.value(config) ? text::toml_real(*s.value(config)) : std::string{};
                               },
                               [&](const Integer& s) { return fmt::format("{}", s.get(config)); },
                               [&](const Text& s) { return text::toml_string(s.value(config)); },
                               [&](const RealList& s) {
                                   return s.may_be_empty && s.value(config).empty()
                                              ? std::string{}
                                              : list_text(s.value(config), text::toml_real);
                               },
                               [&](const ChoiceList& s) { return choices_text(s, config); },
                               [&](const Interval&) { return interval_text(config.switching); },
                               [&](const Choice& s) { return choice_text(s, config); },
                               [&](const Column& s) { return column_text(s.value(config)); },
                               [&](const Points& s) { return points_text(s.value(config)); }},
                      key.slot);
}

std::string allowed_text(const Key& key) {
    return std::visit(
        Overload{
            [](const Real& s) { return in_words(s.range); }, [](const OptionalReal& s) { return in_words(s.range); },
            [](const Integer& s) { return fmt::format("{}{}{}", s.min, s.without_between ? " or " : "..", s.max); },
            [](const Text&) { return std::string{"any text"}; },
            [](const RealList& s) {
                return fmt::format("one number or an array{}, each {}", s.may_be_empty ? ", [] included" : "",
                                   in_words(s.range));
            },
            [](const ChoiceList& s) {
                return fmt::format("one or an array, [] included, of \"{}\"",
                                   fmt::join(s.names.begin(), s.names.end(), "\", \""));
            },
            [](const Interval& s) { return fmt::format("{}, or \"optimal\"", in_words(s.range)); },
            [](const Choice& s) { return fmt::format("\"{}\"", fmt::join(s.names.begin(), s.names.end(), "\", \"")); },
            [](const Points&) { return std::string{"pairs [[x, y], ...] with rising x, or the path of a file"}; },
            [](const Column& s) { return fmt::format("a number {}..1000000, or a name", s.may_be_none ? 0 : 1); }},
        key.slot);
}

void check_range(const Key& key, const Config& config) {
    if (is_within(key.slot, config)) return;
    throw ConfigError(fmt::format("{} = {}: allowed is {}", dotted(key), value_text(key, config), allowed_text(key)));
}

}  // namespace zlg::config
