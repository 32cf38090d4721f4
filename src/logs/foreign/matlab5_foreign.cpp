// MATLAB 5: real matrices, and those in structures.

#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <zlg/logs/error.hpp>

#include "foreign_readers.hpp"
#include "matlab5_extent.hpp"

namespace zlg::logs {

namespace {

using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

template <class Number>
bool copy(const matvar_t& v, std::vector<double>& values) {
    if (v.data_size != sizeof(Number)) return false;
    const auto* from = static_cast<const Number*>(v.data);
    for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<double>(from[k]);
    return true;
}

// As MATLAB gives the type of what is in memory.
bool copy_numbers(const matvar_t& v, std::vector<double>& values) {
    switch (v.class_type) {
        case MAT_C_DOUBLE:
            return copy<double>(v, values);
        case MAT_C_SINGLE:
            return copy<float>(v, values);
        case MAT_C_INT8:
            return copy<std::int8_t>(v, values);
        case MAT_C_UINT8:
            return copy<std::uint8_t>(v, values);
        case MAT_C_INT16:
            return copy<std::int16_t>(v, values);
        case MAT_C_UINT16:
            return copy<std::uint16_t>(v, values);
        case MAT_C_INT32:
            return copy<std::int32_t>(v, values);
        case MAT_C_UINT32:
            return copy<std::uint32_t>(v, values);
        case MAT_C_INT64:
            return copy<std::int64_t>(v, values);
        case MAT_C_UINT64:
            return copy<std::uint64_t>(v, values);
        default:
            return false;
    }
}

class Reader {
public:
    explicit Reader(const std::string& path) : path_{path} {}

    void take(const matvar_t& v, const std::string& name, int depth) {
        if (v.class_type == MAT_C_STRUCT && depth < 4) return take_fields(v, name, depth);
        if (v.rank != 2 || v.data == nullptr || v.isComplex != 0) return leave_out(name);
        const std::size_t rows = v.dims[0], columns = v.dims[1];
        if (rows * columns < 2) return;
        if (std::min(rows, columns) > 1000 || rows > max_foreign_values || columns > max_foreign_values)
            return leave_out(name);
        ForeignArray array{.name = name, .unit = {}, .values = std::vector<double>(rows * columns), .not_plain = {}};
        if (v.nbytes < array.values.size() * static_cast<std::size_t>(v.data_size) || !copy_numbers(v, array.values))
            return leave_out(name);
        const bool whole = v.class_type == MAT_C_INT64 || v.class_type == MAT_C_UINT64;
        if (whole && std::ranges::any_of(array.values, [](double x) { return std::fabs(x) >= 9007199254740992.0; }))
            throw FormatError(fmt::format("{}, {}: allowed are whole numbers below 2^53", path_, name));
        // MATLAB stores column by column; the longer side are the rows.
        array.rows = std::max(rows, columns);
        array.columns = std::min(rows, columns);
        array.rows_follow = rows < columns;
        arrays.push_back(std::move(array));
    }

    std::vector<ForeignArray> arrays;
    std::vector<std::string> notes;

private:
    void leave_out(const std::string& name) {
        if (notes.size() < 10) notes.push_back(fmt::format("'{}' is left out: it is no real matrix", name));
    }

    void take_fields(const matvar_t& v, const std::string& name, int depth) {
        const unsigned n = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&v));
        char* const* names = Mat_VarGetStructFieldnames(&v);
        for (unsigned f = 0; f < n && names != nullptr; ++f)
            if (const matvar_t* field = Mat_VarGetStructFieldByName(const_cast<matvar_t*>(&v), names[f], 0))
                take(*field, fmt::format("{}.{}", name, names[f]), depth + 1);
    }

    const std::string& path_;
};

}  // namespace

ForeignTable matlab5_table_of(const std::string& path, const Mapping& mapping) {
    check_matlab5_extent(path);
    const std::unique_ptr<mat_t, decltype(&Mat_Close)> file{Mat_Open(path.c_str(), MAT_ACC_RDONLY), &Mat_Close};
    if (!file) throw FormatError(fmt::format("{}: cannot be read as a MATLAB 5 file", path));
    Reader reader{path};
    const std::string asked = mapping.text("table");
    bool found = asked.empty();
    while (true) {
        const Variable v{Mat_VarReadNext(file.get()), &Mat_VarFree};
        if (!v) break;
        const std::string name = v->name == nullptr ? "" : v->name;
        if (!asked.empty() && name != asked) continue;
        found = true;
        reader.take(*v, name, 0);
    }
    if (!found) throw MappingError(fmt::format("{}: table = '{}': there is no such variable", path, asked));
    ForeignTable table = table_of_arrays(path, "a MATLAB 5 file", std::move(reader.arrays));
    table.notes.insert(table.notes.end(), reader.notes.begin(), reader.notes.end());
    return table;
}

}  // namespace zlg::logs
