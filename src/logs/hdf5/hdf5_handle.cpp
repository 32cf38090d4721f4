#include "hdf5_handle.hpp"

#include <string_view>

namespace zlg::logs::hdf5 {

namespace {

// The drivers put the system's words into the remark so: `..., error message = 'No space left on device', ...`.
std::string words_of_system(std::string_view remark) {
    constexpr std::string_view mark = "error message = '";
    const auto begin = remark.find(mark);
    if (begin == std::string_view::npos) return {};
    const std::string_view rest = remark.substr(begin + mark.size());
    return std::string{rest.substr(0, rest.find('\''))};
}

// The stack is walked from the innermost call outward.
herr_t collect(unsigned, const H5E_error2_t* entry, void* client) noexcept try {
    Failure& failure = *static_cast<Failure*>(client);
    const std::string_view remark = entry->desc != nullptr ? entry->desc : "";
    if (failure.is_of_system) return 0;
    if (std::string words = words_of_system(remark); !words.empty()) {
        failure = {std::move(words), true};
    } else if (failure.reason.empty()) {
        failure.reason = remark;
    }
    return 0;
} catch (...) {
    return -1;
}

}  // namespace

Handle text_type(std::size_t size) {
    Handle type{H5Tcopy(H5T_C_S1), &H5Tclose};
    H5Tset_size(type.get(), size);
    if (size != H5T_VARIABLE) H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
    H5Tset_cset(type.get(), H5T_CSET_UTF8);
    return type;
}

Handle creation_of(hid_t kind) {
    Handle creation{H5Pcreate(kind), &H5Pclose};
    H5Pset_obj_track_times(creation.get(), false);
    return creation;
}

void keep_quiet() {
    thread_local const herr_t silenced = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    static_cast<void>(silenced);
}

Failure last_failure() {
    Failure failure;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, &collect, &failure);
    for (char& c : failure.reason) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    }
    if (failure.reason.empty()) failure.reason = "no reason given";
    return failure;
}

}  // namespace zlg::logs::hdf5
