#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <zlg/logs/column_file.hpp>
#include <zlg/logs/error.hpp>

#include "hdf5_column.hpp"
#include "hdf5_handle.hpp"
#include "hdf5_source.hpp"
#include "hdf5_storage.hpp"
#include "part_file.hpp"

namespace zlg::logs {
namespace {

using hdf5::Handle;

constexpr hsize_t max_rows = 100'000'000;

// What must not fail but for want of memory.
Handle made(hid_t id, Handle::Closer closer) {
    if (id < 0) throw IoError(fmt::format("cannot make an HDF5 file: {}", hdf5::last_failure().reason));
    return {id, closer};
}

void require(herr_t outcome) {
    (void)made(outcome, [](hid_t) -> herr_t { return 0; });
}

// A type has at least one letter.
Handle letters_type(std::size_t size) { return hdf5::text_type(std::max<std::size_t>(size, 1)); }

// The texts one behind the other, each filled up with zeros to the length of the longest.
struct Letters {
    explicit Letters(const std::vector<std::string>& texts) {
        for (const std::string& text : texts) width = std::max(width, text.size());
        letters.assign(std::max<std::size_t>(texts.size() * width, 1), '\0');
        for (std::size_t k = 0; k < texts.size(); ++k) texts[k].copy(&letters[k * width], width);
    }

    std::size_t width = 1;
    std::string letters;
};

void set_attribute(hid_t object, const char* name, hid_t file_type, hid_t type, const void* value) {
    const Handle attribute =
        made(H5Acreate2(object, name, file_type, hdf5::scalar().get(), H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
    require(H5Awrite(attribute.get(), type, value));
}

Handle add_set(hid_t file, const std::string& path, hid_t type, const Handle& space, const void* values) {
    const Handle creation = hdf5::creation_of(H5P_DATASET_CREATE);
    Handle set =
        made(H5Dcreate2(file, path.c_str(), type, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), &H5Dclose);
    require(H5Dwrite(set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
    return set;
}

struct AddColumn {
    hid_t file;
    std::string path;

    [[nodiscard]] Handle line(hsize_t n) const { return made(H5Screate_simple(1, &n, nullptr), &H5Sclose); }
    template <class T> [[nodiscard]] Handle operator()(const std::vector<T>& values) const {
        return add_set(file, path, std::is_same_v<T, double> ? H5T_IEEE_F64LE : H5T_STD_I64LE, line(values.size()),
                       values.data());
    }
    [[nodiscard]] Handle operator()(const std::vector<std::string>& texts) const {
        const Letters all{texts};
        return add_set(file, path, letters_type(all.width).get(), line(texts.size()), all.letters.data());
    }
};

void fill(hid_t file, const ColumnFile& content) {
    for (const auto& [name, value] : content.marks)
        set_attribute(file, name.c_str(), H5T_STD_I64LE, H5T_NATIVE_INT64, &value);
    for (const auto& [name, text] : content.texts)
        (void)add_set(file, name, letters_type(text.size()).get(), hdf5::scalar(), text.c_str());
    const Handle creation = hdf5::creation_of(H5P_GROUP_CREATE);
    const Handle group =
        made(H5Gcreate2(file, content.group.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), &H5Gclose);
    for (const FileColumn& column : content.columns) {
        const Handle set = std::visit(AddColumn{file, content.group + "/" + column.name}, column.values);
        const Handle type = letters_type(column.unit.size());
        set_attribute(set.get(), "unit", type.get(), type.get(), column.unit.c_str());
    }
}

// All in memory, where nothing but memory can fail.
void fill(hdf5::Storage& storage, const ColumnFile& content) {
    const Handle access = access_to(storage);
    const Handle creation = hdf5::creation_of(H5P_FILE_CREATE);
    Handle file = made(H5Fcreate("results", H5F_ACC_TRUNC, creation.get(), access.get()), &H5Fclose);
    fill(file.get(), content);
    if (!file.close()) require(-1);
}

}  // namespace

void write_columns(const std::string& path, const ColumnFile& content) {
    hdf5::keep_quiet();
    const std::string fresh = path + ".new";
    const FileDescriptor file{::open(fresh.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
    if (!file.is_open()) fail_io("create", fresh, errno);
    hdf5::Storage storage{file.get()};
    fill(storage, content);
    storage.publish();
    int error = storage.error();
    // Before the name: after a failure of power there is the old file or the new one.
    if (error == 0 && ::fsync(file.get()) != 0) error = errno;
    if (error == 0 && ::rename(fresh.c_str(), path.c_str()) == 0) return;
    if (error == 0) error = errno;
    ::unlink(fresh.c_str());
    fail_io("write", path, error);
}

struct ColumnReader::State {
    hdf5::Source source;
    std::string group;

    template <class T> [[nodiscard]] std::vector<T> numbers(const std::string& name) const {
        const hdf5::DataSet set{source, require_there(name), {.is_integer = !std::is_floating_point_v<T>}};
        if (set.rows() > max_rows)
            source.fail(set.path(), fmt::format("has {} rows; allowed are {}", set.rows(), max_rows));
        std::vector<T> values(set.rows());
        if (!values.empty()) set.read(0, values.size(), hdf5::memory_type<T>(), values.data());
        return values;
    }

    [[nodiscard]] std::string require_there(const std::string& name) const {
        std::string path = group + "/" + name;
        if (!source.has(path)) throw FormatError(fmt::format("{}: {} is missing", source.path(), path));
        return path;
    }
};

ColumnReader::ColumnReader(std::string path, std::string group)
    : state_{std::make_unique<State>(State{hdf5::Source{std::move(path)}, std::move(group)})} {}
ColumnReader::~ColumnReader() = default;
ColumnReader::ColumnReader(ColumnReader&&) noexcept = default;
ColumnReader& ColumnReader::operator=(ColumnReader&&) noexcept = default;

std::string ColumnReader::text(const std::string& name) const {
    if (auto text = state_->source.text(name)) return *std::move(text);
    throw FormatError(fmt::format("{}: {} is missing", state_->source.path(), name));
}

std::int64_t ColumnReader::mark(const char* name) const {
    constexpr double most = 0x1p53;  // beyond, a real number skips integers
    const auto value = state_->source.real_attribute(name);
    if (!value) throw FormatError(fmt::format("{}: the attribute {} is missing", state_->source.path(), name));
    if (!(std::abs(*value) <= most))
        throw FormatError(fmt::format("{}: the attribute {} is {}; allowed is an integer of at most {} in size",
                                      state_->source.path(), name, *value, most));
    return static_cast<std::int64_t>(*value);
}

std::vector<std::int64_t> ColumnReader::integers(const std::string& name) const {
    return state_->numbers<std::int64_t>(name);
}
std::vector<double> ColumnReader::reals(const std::string& name) const { return state_->numbers<double>(name); }

std::vector<std::string> ColumnReader::texts(const std::string& name) const {
    const hdf5::Source& source = state_->source;
    const std::string path = state_->require_there(name);
    const Handle set{H5Dopen2(source.id(), path.c_str(), H5P_DEFAULT), &H5Dclose};
    if (!set.is_open()) source.fail_to_read(path);
    const Handle type{H5Dget_type(set.get()), &H5Tclose};
    const Handle space{H5Dget_space(set.get()), &H5Sclose};
    const std::size_t width = H5Tget_size(type.get());
    const bool is_letters = H5Tget_class(type.get()) == H5T_STRING && H5Tis_variable_str(type.get()) == 0;
    const bool is_line = H5Sget_simple_extent_ndims(space.get()) == 1;
    const hssize_t n = H5Sget_simple_extent_npoints(space.get());
    const hsize_t stored_bytes = H5Dget_storage_size(set.get());
    if (!is_letters || !is_line || n < 0 || width < 1)
        source.fail(path, "holds another type; allowed are texts of one length");
    if (static_cast<hsize_t>(n) > max_rows) source.fail(path, fmt::format("has {} rows; allowed are {}", n, max_rows));
    if (stored_bytes != static_cast<hsize_t>(n) * width) source.fail(path, "is not stored in one piece");
    std::vector<char> letters(stored_bytes);
    if (n > 0 && H5Dread(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, letters.data()) < 0)
        source.fail_to_read(path);
    std::vector<std::string> texts;
    for (std::size_t k = 0; k < static_cast<std::size_t>(n); ++k)
        texts.emplace_back(&letters[k * width], ::strnlen(&letters[k * width], width));
    return texts;
}

}  // namespace zlg::logs
