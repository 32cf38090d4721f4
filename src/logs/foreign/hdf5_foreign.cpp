// HDF5 of any writer, MATLAB 7.3 among them: numeric data sets of one or two dimensions.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <zlg/logs/error.hpp>
#include <zlg/logs/file_nature.hpp>
#include <zlg/text/spelling.hpp>

#include "foreign_readers.hpp"
#include "hdf5/hdf5_source.hpp"

namespace zlg::logs {

namespace {

using hdf5::Handle;
using hdf5::Source;

constexpr int max_depth = 8;
constexpr double exact_whole = 9007199254740992.0;  // 2^53

// Whole numbers beyond 2^53 would be rounded on the way.
void check_exact(const Source& file, const std::string& path, hid_t type, const std::vector<double>& values) {
    if (H5Tget_class(type) != H5T_INTEGER || H5Tget_size(type) < 8) return;
    for (const double v : values)
        if (std::fabs(v) >= exact_whole)
            file.fail(path, fmt::format("holds {:.17g}; allowed are whole numbers below 2^53", v));
}

std::string unit_of(const Source& file, const std::string& path) {
    for (const char* name : {"unit", "units", "Unit", "Units"}) {
        try {
            if (const auto unit = file.text_attribute(path, name)) return *unit;
        } catch (const FormatError&) {
            // An attribute of that name that is no text says nothing.
        }
    }
    return {};
}

// What its attributes make of the numbers of a data set, where that is not the numbers themselves.
struct Attributes {
    const std::vector<double>& values;
    std::string not_plain;
};

herr_t take_attribute(hid_t set, const char* name, const H5A_info_t*, void* client) noexcept try {
    constexpr std::array<std::string_view, 8> factors{"scale_factor", "scale",  "scaling", "gain",
                                                      "lsb",          "factor", "slope",   "multiplier"};
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

std::string not_plain(const Source& file, const std::string& path, hid_t set, const std::vector<double>& values) {
    Attributes found{.values = values, .not_plain = {}};
    if (H5Aiterate2(set, H5_INDEX_NAME, H5_ITER_INC, nullptr, &take_attribute, &found) < 0) file.fail_to_read(path);
    return found.not_plain;
}

class Reader {
public:
    explicit Reader(const std::string& path) : file_{path} {}

    std::vector<ForeignArray> all(const std::string& from) {
        const Handle object{H5Oopen(file_.id(), from.c_str(), H5P_DEFAULT), &H5Oclose};
        if (!object.is_open())
            throw MappingError(fmt::format("{}: table = '{}': there is no such group or data set", file_.path(), from));
        if (H5Iget_type(object.get()) == H5I_DATASET)
            take(from, from.substr(from.rfind('/') + 1));
        else
            walk(from == "/" ? "" : from, "", 0);
        return std::move(arrays_);
    }
    std::vector<std::string> notes;

private:
    void walk(const std::string& group, const std::string& prefix, int depth) {
        if (depth > max_depth) return;
        for (const std::string& name : file_.members(group.empty() ? "/" : group)) {
            if (name.starts_with('#')) continue;  // what MATLAB keeps for itself
            const std::string path = group + "/" + name;
            const Handle object{H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT), &H5Oclose};
            if (!object.is_open()) file_.fail_to_read(path);
            const H5I_type_t kind = H5Iget_type(object.get());
            if (kind == H5I_GROUP) walk(path, prefix + name + "/", depth + 1);
            if (kind == H5I_DATASET) take(path, prefix + name);
        }
    }

    void leave_out(const std::string& name, const char* why) {
        if (notes.size() < 10) notes.push_back(fmt::format("'{}' is left out: {}", name, why));
    }

    void take(const std::string& path, const std::string& name) {
        const Handle set{H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT), &H5Dclose};
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
        const std::size_t n = size[0] * size[1];
        if (n < 2) return;
        if (size[0] > max_foreign_values || size[1] > max_foreign_values || n > max_foreign_values)
            file_.fail(path, fmt::format("{} values; allowed is {}", n, max_foreign_values));
        ForeignArray array{.name = name, .unit = unit_of(file_, path), .values = {}, .not_plain = {}};
        // Of a matrix the longer side are the rows, whichever way round its writer stores it.
        array.rows = std::max(size[0], size[1]);
        array.columns = std::min(size[0], size[1]);
        array.rows_follow = size[0] >= size[1];
        if (array.columns > 1000) return leave_out(name, "neither of its sides is below 1000");
        array.values.resize(n);
        if (H5Dread(set.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) < 0)
            file_.fail_to_read(path);
        check_exact(file_, path, type.get(), array.values);
        array.not_plain = not_plain(file_, path, set.get(), array.values);
        arrays_.push_back(std::move(array));
    }

    Source file_;
    std::vector<ForeignArray> arrays_;
};

}  // namespace

ForeignTable hdf5_table_of(const std::string& path, const Mapping& mapping) {
    std::string from = mapping.text("table");
    if (!from.starts_with('/')) from = "/" + from;
    Reader reader{path};
    std::vector<ForeignArray> arrays = reader.all(from);
    ForeignTable table = table_of_arrays(path, foreign_nature(path), std::move(arrays));
    table.notes.insert(table.notes.end(), reader.notes.begin(), reader.notes.end());
    return table;
}

}  // namespace zlg::logs
