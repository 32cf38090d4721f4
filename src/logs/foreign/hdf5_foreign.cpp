// HDF5 of any writer, MATLAB 7.3 among them: numeric data sets of one or two dimensions.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>
#include <zlg/logs/budget.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/file_nature.hpp>
#include <zlg/text/escape.hpp>
#include <zlg/text/spelling.hpp>

#include "foreign_readers.hpp"
#include "hdf5/hdf5_column.hpp"
#include "hdf5/hdf5_source.hpp"

namespace zlg::logs {

namespace {

using hdf5::Handle;
using hdf5::Source;

constexpr int max_groups = 8;
#if H5_VERSION_GE(1, 12, 0)
using ObjectInfo = H5O_info1_t;
#else
using ObjectInfo = H5O_info_t;
#endif

// Where its attributes contradict each other all are named, which together are no unit.
std::string stored_unit(const Source& file, const std::string& path) {
    std::string all;
    for (const char* name : {"unit", "units", "Unit", "Units"}) {
        try {
            const auto unit = file.text_attribute(path, name);
            if (unit && all.find(*unit) == std::string::npos) all += all.empty() ? *unit : " or " + *unit;
        } catch (const FormatError&) {
            // An attribute of that name that is no text says nothing.
        }
    }
    return all;
}

// What its attributes make of the numbers of a data set, where that is not the numbers themselves.
struct Attributes {
    const std::vector<double>& values;
    std::string not_plain;
};

herr_t take_attribute(hid_t set, const char* name, const H5A_info_t*, void* client) noexcept try {
    constexpr std::array<std::string_view, 11> factors{"scale_factor", "scale",       "scaling",    "gain",
                                                       "lsb",          "factor",      "slope",      "multiplier",
                                                       "conversion",   "sensitivity", "scalefactor"};
    constexpr std::array<std::string_view, 3> offsets{"add_offset", "offset", "intercept"};
    constexpr std::array<std::string_view, 2> fills{"_fillvalue", "missing_value"};
    Attributes& found = *static_cast<Attributes*>(client);
    const std::string small = zlg::text::lower_case(name);
    const bool is_factor = std::ranges::find(factors, small) != factors.end();
    const bool is_fill = std::ranges::find(fills, small) != fills.end();
    if (!is_factor && !is_fill && std::ranges::find(offsets, small) == offsets.end()) return 0;
    const Handle attribute{H5Aopen(set, name, H5P_DEFAULT), &H5Aclose};
    const Handle type{H5Aget_type(attribute.get()), &H5Tclose};
    const Handle space{H5Aget_space(attribute.get()), &H5Sclose};
    const H5T_class_t kind = H5Tget_class(type.get());
    std::string shown = "no single number";
    if ((kind == H5T_FLOAT || kind == H5T_INTEGER) && H5Sget_simple_extent_npoints(space.get()) == 1) {
        double value = NAN;
        if (H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value) < 0) return -1;
        if (is_fill ? std::ranges::find(found.values, value) == found.values.end() : value == (is_factor ? 1.0 : 0.0))
            return 0;
        shown = fmt::format("{}", value);
    }
    found.not_plain = fmt::format(
        "its attribute {} is {}, which is not applied; allowed are numbers that stand for "
        "themselves, with the attribute removed",
        name, shown);
    return 1;
} catch (...) {
    return -1;
}

// A data set that is read when its numbers are asked for.
struct StoredSet {
    std::shared_ptr<Source> file;
    std::string path;
    std::string name;
    Handle set;
    std::size_t rows = 0;
    std::size_t columns = 1;
    int rank = 1;
    bool rows_follow = true;
    hdf5::Chunks chunks;

    // The numbers are what they stand for.
    void check(const std::vector<double>& values) const {
        Attributes found{.values = values, .not_plain = {}};
        if (H5Aiterate2(set.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, &take_attribute, &found) < 0)
            file->fail_to_read(path);
        if (!found.not_plain.empty())
            throw FormatError(
                fmt::format("{}, '{}': {}", file->path(), zlg::text::excerpt(name, 60, ' '), found.not_plain));
    }

    // Of those read at once the library keeps some kB for each chunk.
    [[nodiscard]] hsize_t rows_at_once() const {
        constexpr hsize_t chunks_at_once = 1024;
        if (chunks.size()[0] == 0) return rows;
        const hsize_t along = chunks.size()[rows_follow ? 0 : 1], across = chunks.size()[rows_follow ? 1 : 0];
        return std::max<hsize_t>(chunks_at_once / ((columns + across - 1) / across), 1) * along;
    }

    // Into the rows of `values`, which begin with `first`; what was never written is missing.
    void read_block(const hdf5::Index& begin, const hdf5::Index& count, const hdf5::Index& first,
                    const hdf5::Index& size, std::vector<double>& values) const {
        const std::vector<hdf5::Index> unwritten = chunks.unwritten(*file, path, set.get(), begin, count);
        const Handle space{H5Dget_space(set.get()), &H5Sclose};
        const Handle memory{H5Screate_simple(rank, size.data(), nullptr), &H5Sclose};
        const hdf5::Index to{begin[0] - first[0], begin[1] - first[1]};
        if (H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, begin.data(), nullptr, count.data(), nullptr) < 0 ||
            H5Sselect_hyperslab(memory.get(), H5S_SELECT_SET, to.data(), nullptr, count.data(), nullptr) < 0 ||
            H5Dread(set.get(), H5T_NATIVE_DOUBLE, memory.get(), space.get(), H5P_DEFAULT, values.data()) < 0)
            file->fail_to_read(path);
        for (const hdf5::Index& at : unwritten)
            for (hsize_t k = std::max(at[0], first[0]); k < std::min(at[0] + chunks.size()[0], first[0] + size[0]); ++k)
                for (hsize_t j = std::max(at[1], first[1]); j < std::min(at[1] + chunks.size()[1], first[1] + size[1]);
                     ++j)
                    values[(k - first[0]) * size[1] + j - first[1]] = NAN;
    }

    [[nodiscard]] std::vector<double> read(std::size_t from, std::size_t n, bool is_used) const {
        std::vector<double> values(n * columns);
        const std::size_t dimension = rows_follow ? 0 : 1;  // that of the rows
        hdf5::Index begin{0, 0}, count{columns, columns}, size{columns, columns};
        begin[dimension] = from;
        size[dimension] = n;
        for (const hdf5::Index first = begin; begin[dimension] < from + n; begin[dimension] += count[dimension]) {
            count[dimension] = std::min<hsize_t>(rows_at_once(), from + n - begin[dimension]);
            read_block(begin, count, first, size, values);
        }
        if (is_used) check(values);
        return rows_follow ? by_columns(std::move(values), columns) : values;
    }
};

class Hdf5Reader {
public:
    explicit Hdf5Reader(const std::string& path)
        : file_{std::make_shared<Source>(path)}, budget_{path, std::filesystem::file_size(path)} {}

    std::vector<ForeignArray> all(const std::string& from) {
        Handle object{H5Oopen(file_->id(), from.c_str(), H5P_DEFAULT), &H5Oclose};
        if (!object.is_open())
            throw MappingError(
                fmt::format("{}: table = '{}': there is no such group or data set", file_->path(), from));
        (void)is_new(object.get(), from);
        const bool is_set = H5Iget_type(object.get()) == H5I_DATASET;
        object.close();
        if (is_set)
            take(from, from.substr(from.rfind('/') + 1));
        else
            walk(from == "/" ? "" : from, "", 0);
        return std::move(arrays_);
    }
    std::vector<std::string> notes;

private:
    // Hard links may lead back: an object that was visited is not visited again.
    bool is_new(hid_t object, const std::string& path) {
        ObjectInfo info;
        if (H5Oget_info1(object, &info) < 0) file_->fail_to_read(path);
        return visited_.emplace(info.fileno, info.addr).second;
    }

    void walk(const std::string& group, const std::string& prefix, int depth) {
        if (depth > max_groups) return leave_out(prefix, "it lies more than 8 groups deep");
        for (const std::string& name : file_->members(group.empty() ? "/" : group)) {
            if (name.starts_with('#')) continue;  // what MATLAB keeps for itself
            budget_.take_object();
            const std::string path = group + "/" + name;
            Handle object{H5Oopen(file_->id(), path.c_str(), H5P_DEFAULT), &H5Oclose};
            if (!object.is_open()) file_->fail_to_read(path);
            if (!is_new(object.get(), path)) {
                leave_out(prefix + name, "it is another name of what was read before");
                continue;
            }
            const H5I_type_t kind = H5Iget_type(object.get());
            object.close();
            if (kind == H5I_GROUP) walk(path, prefix + name + "/", depth + 1);
            if (kind == H5I_DATASET) take(path, prefix + name);
        }
    }

    void leave_out(const std::string& name, const char* why) {
        if (notes.size() < 10)
            notes.push_back(fmt::format("'{}' is left out: {}", zlg::text::excerpt(name, 60, ' '), why));
    }

    // Nothing else has it open, or the library would go on with the cache of that.
    void take(const std::string& path, const std::string& name) {
        const Handle access = hdf5::access_with_cache(0);
        Handle set{H5Dopen2(file_->id(), path.c_str(), access.get()), &H5Dclose};
        if (!set.is_open()) file_->fail_to_read(path);
        const Handle type{H5Dget_type(set.get()), &H5Tclose};
        const Handle space{H5Dget_space(set.get()), &H5Sclose};
        const Handle creation{H5Dget_create_plist(set.get()), &H5Pclose};
        const H5T_class_t kind = H5Tget_class(type.get());
        if (kind != H5T_FLOAT && kind != H5T_INTEGER) return leave_out(name, "it holds no plain numbers");
        if (H5Pget_layout(creation.get()) == H5D_VIRTUAL || H5Pget_external_count(creation.get()) != 0)
            return leave_out(name, "it lies in another file");
        const int rank = H5Sget_simple_extent_ndims(space.get());
        if (rank < 1 || rank > 2) return leave_out(name, "it has neither one nor two dimensions");
        hsize_t size[2] = {0, 1};
        H5Sget_simple_extent_dims(space.get(), size, nullptr);
        if (size[0] == 0 || size[1] == 0 || (size[0] == 1 && size[1] == 1)) return;
        if (H5Dget_storage_size(set.get()) == 0) return leave_out(name, "nothing was ever written into it");
        if (std::min(size[0], size[1]) > max_matrix_columns)
            return leave_out(name, "neither of its sides is below 1000");
        hdf5::Chunks chunks{*file_, path, set.get(), sizeof(double) * budget_.max_values()};
        budget_.take_values(size[0], size[1]);
        if (const hdf5::Index& chunk = chunks.size(); chunk[0] != 0)
            budget_.take_chunks(((size[0] - 1) / chunk[0] + 1) * ((size[1] - 1) / chunk[1] + 1),
                                chunks.are_packed() ? chunks.bytes() / sizeof(double) : 0);
        const bool rows_follow = size[0] >= size[1];
        // Of a matrix the longer side are the rows, whichever way round its writer stores it.
        ForeignArray array{.name = name,
                           .unit = stored_unit(*file_, path),
                           .rows = std::max(size[0], size[1]),
                           .columns = std::min(size[0], size[1]),
                           .may_be_rounded = kind == H5T_INTEGER && H5Tget_size(type.get()) >= 8,
                           .rows_at_once = std::max<hsize_t>(1, chunks.size()[rows_follow ? 0 : 1]),
                           .read = {}};
        array.read = [stored = std::make_shared<const StoredSet>(StoredSet{.file = file_,
                                                                           .path = path,
                                                                           .name = name,
                                                                           .set = std::move(set),
                                                                           .rows = array.rows,
                                                                           .columns = array.columns,
                                                                           .rank = rank,
                                                                           .rows_follow = rows_follow,
                                                                           .chunks = std::move(chunks)})](
                         std::size_t from, std::size_t n, bool is_used) { return stored->read(from, n, is_used); };
        arrays_.push_back(std::move(array));
    }

    std::shared_ptr<Source> file_;
    Budget budget_;
    std::set<std::pair<unsigned long, haddr_t>> visited_;
    std::vector<ForeignArray> arrays_;
};

}  // namespace

ForeignTable hdf5_table_of(const std::string& path, const Mapping& mapping) {
    std::string from = mapping.text("table");
    if (!from.starts_with('/')) from = "/" + from;
    Hdf5Reader reader{path};
    std::vector<ForeignArray> arrays = reader.all(from);
    return table_of_arrays(path, foreign_nature(path), std::move(arrays), reader.notes);
}

}  // namespace zlg::logs
