#pragma once
// What libc++ before 15 lacks of std::ranges of what the readers of text name: the algorithms over whole ranges, with a
// projection. Included before every source of the module that reads a file of another program.

#include <algorithm>
#include <functional>
#include <ranges>

#if _LIBCPP_VERSION < 15000
namespace std::ranges {

template <class Range, class Is, class Of = identity> constexpr auto find_if(Range&& range, Is is, Of of = {}) {
    return std::find_if(begin(range), end(range), [&](auto&& each) { return invoke(is, invoke(of, each)); });
}

template <class Range, class Value, class Of = identity>
constexpr auto find(Range&& range, const Value& value, Of of = {}) {
    return ranges::find_if(
        range, [&](const auto& each) { return each == value; }, of);
}

template <class Range, class Is, class Of = identity> constexpr bool any_of(Range&& range, Is is, Of of = {}) {
    return ranges::find_if(range, is, of) != end(range);
}

template <class Range, class Is, class Of = identity> constexpr bool all_of(Range&& range, Is is, Of of = {}) {
    return !ranges::any_of(
        range, [&](auto&& each) { return !invoke(is, each); }, of);
}

template <class Range, class Is, class Of = identity> constexpr auto count_if(Range&& range, Is is, Of of = {}) {
    return std::count_if(begin(range), end(range), [&](auto&& each) { return invoke(is, invoke(of, each)); });
}

template <class Range, class Less = std::less<>, class Of = identity>
constexpr auto max_element(Range&& range, Less less = {}, Of of = {}) {
    return std::max_element(begin(range), end(range),
                            [&](auto&& a, auto&& b) { return invoke(less, invoke(of, a), invoke(of, b)); });
}

}  // namespace std::ranges
#endif
