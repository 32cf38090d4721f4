#pragma once
// The identifiers of the HDF5 library as objects that close themselves, and what it says when something fails.

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>

namespace zlg::logs::hdf5 {

class Handle {
public:
    using Closer = herr_t (*)(hid_t);

    Handle() = default;
    Handle(hid_t id, Closer closer) : id_{id}, closer_{closer} {}
    ~Handle() { close(); }
    Handle(Handle&& other) noexcept : id_{std::exchange(other.id_, -1)}, closer_{other.closer_} {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(closer_, other.closer_);
        return *this;
    }

    [[nodiscard]] hid_t get() const { return id_; }
    [[nodiscard]] bool is_open() const { return id_ >= 0; }

    bool close() { return id_ < 0 || closer_(std::exchange(id_, -1)) >= 0; }

private:
    hid_t id_ = -1;
    Closer closer_ = nullptr;
};

template <class T> hid_t memory_type() {
    if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
    if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
    if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
    if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
    if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_NATIVE_UINT32;
    if constexpr (std::is_same_v<T, std::int8_t>) return H5T_NATIVE_INT8;
    if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
}

// A text of so many bytes, or H5T_VARIABLE, in UTF-8. One of a fixed size has no zero at its end, for the library puts
// it in the place of the last letter where a program writes the text anew.
[[nodiscard]] Handle text_type(std::size_t size);

// How objects of a kind are made: without times, so that the same rows make the same file.
[[nodiscard]] Handle creation_of(hid_t kind);

[[nodiscard]] inline Handle scalar() { return {H5Screate(H5S_SCALAR), &H5Sclose}; }

// The library would print every failure to stderr, also one that is expected and handled. Once per thread.
void keep_quiet();

struct Failure {
    std::string reason;         // in the words of the system or, without those, of the library's innermost remark
    bool is_of_system = false;  // the reason is the system's: the file could not be opened, read or written
};

// Of the last call in this thread that failed.
[[nodiscard]] Failure last_failure();

}  // namespace zlg::logs::hdf5
