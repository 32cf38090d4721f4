#pragma once
// What libc++ for wasm32 lacks of what toml++ names. Included before every source of the module that reads TOML.

#include <charconv>
#include <fstream>
#include <istream>
#include <string>

#include <fast_float/fast_float.h>

// std::from_chars of a real number, as C++17 has it, by fast_float.
#if _LIBCPP_VERSION < 200000
namespace std {

inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const fast_float::from_chars_result read = fast_float::from_chars(first, last, value);
    return {read.ptr, read.ec};
}

}  // namespace std
#endif

// Without files there is since libc++ 18 no stream of them: its name, for a function of toml++ that is never called.
#ifdef _LIBCPP_HAS_NO_FILESYSTEM
_LIBCPP_BEGIN_NAMESPACE_STD

template <class Character, class Traits> class basic_ifstream : public basic_istream<Character, Traits> {
public:
    basic_ifstream() : basic_istream<Character, Traits>(nullptr) {}
    void open(const string&, ios_base::openmode) {}
    bool is_open() const { return false; }
};

_LIBCPP_END_NAMESPACE_STD
#endif
