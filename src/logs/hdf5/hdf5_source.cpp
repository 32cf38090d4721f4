#include "hdf5_source.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <zlg/logs/error.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/inputs.hpp>

#include <zlg/logs/file_nature.hpp>
#include "hdf5_driver.hpp"

namespace zlg::logs::hdf5 {

namespace {

constexpr std::size_t max_text_bytes = std::size_t{16} << 20;
constexpr std::size_t max_members = 1000;

// While a file grows, a piece that is just being written is read again after 1 ns, 2 ns, 4 ns, and so on: 70 ms in all.
// The library's own 100 attempts would take for ever on a damaged piece.
constexpr unsigned read_attempts = 26;

// Of the superblock from version 2 on; a writer sets them and clears them when it closes the file.
enum StateOfFile : unsigned { open_for_writing = 1u << 0, open_for_readers = 1u << 2 };

unsigned state_of(int fd, const std::string& path) {
    constexpr std::size_t version = 8;
    constexpr std::size_t flags = 11;
    std::array<unsigned char, flags + 1> head{};
    const long long offset = hdf5_offset(fd, path);
    if (offset < 0) return 0u;
    const ssize_t n = ::pread(fd, head.data(), head.size(), offset);
    return n == static_cast<ssize_t>(head.size()) && head[version] >= 2 ? head[flags] : 0u;
}

Handle open_file(const std::string& path, int fd) {
    const unsigned state = state_of(fd, path);
    if ((state & open_for_writing) != 0 && (state & open_for_readers) == 0) {
        throw FormatError(fmt::format(
            "{}: open in, or left unfinished by, a program that does not write for simultaneous readers (HDF5's SWMR)",
            path));
    }
    // Locks would keep readers from a file that is being written, and some file systems have none.
    const Handle access = access_to_read(fd);
    H5Pset_file_locking(access.get(), false, true);
    const bool grows = (state & open_for_readers) != 0;
    if (grows) H5Pset_metadata_read_attempts(access.get(), read_attempts);
    const unsigned mode = grows ? H5F_ACC_RDONLY | H5F_ACC_SWMR_READ : H5F_ACC_RDONLY;
    Handle opened{H5Fopen(path.c_str(), mode, access.get()), &H5Fclose};
    if (opened.is_open()) return opened;
    const Failure failure = last_failure();
    if (state_of(fd, path) != state) {  // the writer has ended in between
        opened = {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.get()), &H5Fclose};
        if (opened.is_open()) return opened;
    }
    if (failure.is_of_system) throw IoError(fmt::format("cannot open {}: {}", path, failure.reason));
    throw FormatError(fmt::format("{}: cannot be read as HDF5: {}", path, failure.reason));
}

// Only what ends within the file: a text of one value, fixed or of its own length.
bool is_one_value(hid_t space) { return H5Sget_simple_extent_npoints(space) == 1; }

std::string up_to_nul(const char* text, std::size_t size) { return {text, ::strnlen(text, size)}; }

// `read(type, buffer)` fetches the value.
template <class Read> std::optional<std::string> read_text(const Handle& type, const Handle& space, Read read) {
    if (H5Tget_class(type.get()) != H5T_STRING || !is_one_value(space.get())) return std::nullopt;
    if (H5Tis_variable_str(type.get()) > 0) {
        char* letters = nullptr;
        if (read(type.get(), &letters) < 0 || letters == nullptr) return std::nullopt;
        const std::string text{letters};
        H5free_memory(letters);
        return text;
    }
    const std::size_t size = H5Tget_size(type.get());
    if (size == 0 || size > max_text_bytes) return std::nullopt;
    std::string text(size, '\0');
    if (read(type.get(), text.data()) < 0) return std::nullopt;
    const std::string whole = up_to_nul(text.data(), size);
    return H5Tget_strpad(type.get()) == H5T_STR_SPACEPAD ? whole.substr(0, whole.find_last_not_of(' ') + 1) : whole;
}

struct Attribute {
    Handle id;
    Handle type;
    Handle space;

    [[nodiscard]] std::optional<std::string> text() const {
        return read_text(type, space, [this](hid_t memory, void* buffer) { return H5Aread(id.get(), memory, buffer); });
    }
};

std::optional<Attribute> attribute_of(const Source& source, const std::string& object, const char* name) {
    const char* const path = object.c_str();
    if (H5Aexists_by_name(source.id(), path, name, H5P_DEFAULT) <= 0) return std::nullopt;
    Handle id{H5Aopen_by_name(source.id(), path, name, H5P_DEFAULT, H5P_DEFAULT), &H5Aclose};
    if (!id.is_open()) source.fail_to_read(object);
    Handle type{H5Aget_type(id.get()), &H5Tclose};
    Handle space{H5Aget_space(id.get()), &H5Sclose};
    return Attribute{std::move(id), std::move(type), std::move(space)};
}

struct Members {
    std::vector<std::string> names;
    bool leads_elsewhere = false;
};

herr_t collect(hid_t, const char* name, const H5L_info_t* link, void* client) noexcept try {
    Members& members = *static_cast<Members*>(client);
    members.names.emplace_back(name);
    members.leads_elsewhere = link->type != H5L_TYPE_HARD;
    return members.leads_elsewhere || members.names.size() > max_members ? 1 : 0;
} catch (...) {
    return -1;
}

}  // namespace

Source::Source(std::string path) : path_{std::move(path)} {
    keep_quiet();
    descriptor_ = open_to_read(path_);
    zlg::text::note_input(descriptor_.get());
    file_ = open_file(path_, descriptor_.get());
}

bool Source::is_complete() const { return (state_of(descriptor_.get(), path_) & open_for_writing) == 0; }

void Source::fail_to_read(const std::string& object) const {
    const Failure failure = last_failure();
    if (failure.is_of_system) throw IoError(fmt::format("cannot read {}: {}", path_, failure.reason));
    fail(object, "cannot be read: " + failure.reason);
}

void Source::fail(const std::string& object, const std::string& what) const {
    throw FormatError(fmt::format("{}, {}: {}", path_, object, what));
}

bool Source::has(const std::string& object) const {
    for (std::size_t slash = object.find('/', 1);; slash = object.find('/', slash + 1)) {
        const std::string parent = object.substr(0, slash);
        if (H5Lexists(file_.get(), parent.c_str(), H5P_DEFAULT) <= 0) return false;
        H5L_info_t link;
        if (H5Lget_info(file_.get(), parent.c_str(), &link, H5P_DEFAULT) < 0) fail_to_read(parent);
        if (link.type != H5L_TYPE_HARD) fail(parent, "a link that leads elsewhere; allowed is an object of this file");
        if (slash == std::string::npos) return true;
    }
}

std::vector<std::string> Source::members(const std::string& group) const {
    const Handle opened{H5Gopen2(file_.get(), group.c_str(), H5P_DEFAULT), &H5Gclose};
    if (!opened.is_open()) fail(group, "is no group");
    Members members;
    if (H5Literate(opened.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, &collect, &members) < 0) fail_to_read(group);
    if (members.leads_elsewhere) {
        fail(group + "/" + members.names.back(), "a link that leads elsewhere; allowed is a data set of this file");
    }
    if (members.names.size() > max_members) fail(group, fmt::format("more than {} data sets", max_members));
    return members.names;
}

std::optional<std::string> Source::text(const std::string& data_set) const {
    if (!has(data_set)) return std::nullopt;
    const Handle set{H5Dopen2(file_.get(), data_set.c_str(), H5P_DEFAULT), &H5Dclose};
    if (!set.is_open()) fail(data_set, "is no data set; allowed is one text");
    const Handle creation{H5Dget_create_plist(set.get()), &H5Pclose};
    const H5D_layout_t layout = H5Pget_layout(creation.get());
    const bool is_outside = H5Pget_external_count(creation.get()) != 0;
    if (is_outside || (layout != H5D_CONTIGUOUS && layout != H5D_COMPACT)) {
        fail(data_set, "is stored outside this file or in chunks; allowed is one text");
    }
    const Handle type{H5Dget_type(set.get()), &H5Tclose};
    const Handle space{H5Dget_space(set.get()), &H5Sclose};
    const auto text = read_text(type, space, [&](hid_t memory_type, void* buffer) {
        return H5Dread(set.get(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer);
    });
    if (!text) fail(data_set, fmt::format("allowed is one text of at most {} bytes", max_text_bytes));
    return text;
}

std::optional<std::string> Source::text_attribute(const std::string& object, const char* name) const {
    const auto attribute = attribute_of(*this, object, name);
    if (!attribute) return std::nullopt;
    const auto text = attribute->text();
    if (!text) fail(object, fmt::format("the attribute {} holds no text that can be read", name));
    return text;
}

std::optional<double> Source::real_attribute(const char* name) const {
    const auto attribute = attribute_of(*this, "/", name);
    if (!attribute) return std::nullopt;
    const auto refuse = [&](const std::string& what) {
        fail("/", fmt::format("the attribute {} is {}; allowed is a finite number", name, what));
    };
    const H5T_class_t kind = H5Tget_class(attribute->type.get());
    if (kind == H5T_STRING) {
        const auto text = attribute->text();
        refuse(text ? fmt::format("the text '{}'", zlg::text::excerpt(*text, 40, '?')) : "not one text");
    }
    if (kind != H5T_FLOAT && kind != H5T_INTEGER) refuse("of a type that holds no number");
    if (!is_one_value(attribute->space.get())) {
        const hssize_t n = H5Sget_simple_extent_npoints(attribute->space.get());
        refuse(fmt::format("a list of {} numbers", std::max<hssize_t>(n, 0)));
    }
    double value = NAN;
    if (H5Aread(attribute->id.get(), H5T_NATIVE_DOUBLE, &value) < 0) fail_to_read("/");
    if (!std::isfinite(value)) refuse(fmt::format("{}", value));
    return value;
}

}  // namespace zlg::logs::hdf5
