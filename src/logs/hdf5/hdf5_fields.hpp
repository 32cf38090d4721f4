#pragma once
// The columns of a log as one list of fields, which its sink and its source go through.

#include <cstddef>
#include <functional>
#include <tuple>
#include <type_traits>
#include <utility>

namespace zlg::logs::hdf5 {

template <class Stored, class Member>
struct Field {
    using Value = Stored;  // type of the number in the file

    std::size_t column;  // its index among the log's columns
    Member member;       // member(row) is the number in a row, as for std::invoke
    Stored absent;       // what a row holds of a column that the log lacks
};

template <class Stored, class Member>
constexpr Field<Stored, Member> field(std::size_t column, Member member, Stored absent = {}) {
    return {column, member, absent};
}

// A tuple of what a sink or a source has of each field: Part<Value>.
template <template <class> class Part, class... Fields>
std::tuple<Part<typename Fields::Value>...> parts_of(const std::tuple<Fields...>&);

// Calls use(field, part) for each field, in order.
template <class Fields, class Parts, class Use>
void for_each_field(const Fields& fields, Parts& parts, Use use) {
    [&]<std::size_t... k>(std::index_sequence<k...>) { (use(std::get<k>(fields), std::get<k>(parts)), ...); }
    (std::make_index_sequence<std::tuple_size_v<Fields>>{});
}

// Writes `value` into a member of the row, as its own type.
template <class Field, class Row>
void set_member(const Field& field, Row& row, typename Field::Value value) {
    auto& member = std::invoke(field.member, row);
    member = static_cast<std::remove_reference_t<decltype(member)>>(value);
}

}  // namespace zlg::logs::hdf5
