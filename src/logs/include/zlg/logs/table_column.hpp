#pragma once
// One column of a log, as a row of the table that the readers and writers of both formats and Python's arrays go
// through.

#include <cstddef>
#include <functional>
#include <tuple>
#include <type_traits>
#include <utility>

namespace zlg::logs {

template <class Stored, class Member, class RowRule, class IsThere> struct TableColumn {
    using Value = Stored;  // type of the number in an HDF5 log and in an array
    using Rule = RowRule;

    const char* name;
    const char* unit;
    Member member;     // member(row) is the value in a row, as for std::invoke
    Rule rule;         // what it must be
    IsThere is_there;  // the member of the log's header that says whether it has the column; null: it must
    Stored absent;     // what a row holds of a column that the log lacks
    bool is_needed;    // without the column, no row with another value can be logged

    static constexpr bool is_optional = !std::is_null_pointer_v<IsThere>;

    template <class Header> [[nodiscard]] constexpr bool is_in(const Header& header) const {
        if constexpr (is_optional) return header.*is_there;
        return true;
    }

    template <class Row> [[nodiscard]] constexpr Stored of(const Row& row) const {
        return static_cast<Stored>(std::invoke(member, row));
    }

    template <class Row> constexpr void set(Row& row, Stored value) const {
        auto& place = std::invoke(member, row);
        place = static_cast<std::remove_reference_t<decltype(place)>>(value);
    }
};

template <class Stored, class Member, class Rule>
constexpr auto required_column(const char* name, const char* unit, Member member, Rule rule) {
    return TableColumn<Stored, Member, Rule, std::nullptr_t>{name, unit, member, rule, nullptr, {}, false};
}

template <class Stored, class Member, class Rule, class Presence>
constexpr auto optional_column(const char* name, const char* unit, Member member, Rule rule, bool Presence::*is_there,
                               Stored absent, bool is_needed = false) {
    return TableColumn<Stored, Member, Rule, bool Presence::*>{name, unit, member, rule, is_there, absent, is_needed};
}

template <class Table> inline constexpr std::size_t n_columns = std::tuple_size_v<decltype(Table::columns)>;

// Calls use(column, k) for every column of a table, k its place from 0.
template <class Table, class Use> constexpr void for_each_column(Use use) {
    [&]<std::size_t... k>(std::index_sequence<k...>) { (use(std::get<k>(Table::columns), k), ...); }
    (std::make_index_sequence<n_columns<Table>>{});
}

template <template <class> class Part, class... Columns>
std::tuple<Part<typename Columns::Value>...> parts_of(const std::tuple<Columns...>&);

// What a reader or a writer has of each column of a table: Part<Value>.
template <class Table, template <class> class Part> using PartsOf = decltype(parts_of<Part>(Table::columns));

// Calls use(column, part, k) for every column of a table and what belongs to it.
template <class Table, class Parts, class Use> constexpr void for_each_column(Parts& parts, Use use) {
    [&]<std::size_t... k>(std::index_sequence<k...>) { (use(std::get<k>(Table::columns), std::get<k>(parts), k), ...); }
    (std::make_index_sequence<n_columns<Table>>{});
}

}  // namespace zlg::logs
