// A valid HDF5 file of almost the right structure: columns of other types, ranks, lengths and storage, groups and links
// in their place, attributes and a /config of any kind.

#include <array>
#include <cstring>

#include "bytes.hpp"
#include "hdf5_objects.hpp"
#include "recognised.hpp"

namespace {

using namespace zlg;
using fuzz::Bytes;

// Any identifier of the library.
class Id {
public:
    explicit Id(hid_t id) : id_{id} {}
    ~Id() {
        if (id_ > 0) H5Idec_ref(id_);
    }
    Id(const Id&) = delete;
    Id& operator=(const Id&) = delete;
    [[nodiscard]] hid_t get() const { return id_; }

private:
    hid_t id_;
};

hid_t string_type(std::size_t size, H5T_cset_t letters) {
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, size);
    H5Tset_cset(type, letters);
    return type;
}

hid_t compound_type() {
    const hid_t type = H5Tcreate(H5T_COMPOUND, 16);
    H5Tinsert(type, "re", 0, H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "im", 8, H5T_NATIVE_DOUBLE);
    return type;
}

hid_t enum_type() {
    const hid_t type = H5Tenum_create(H5T_NATIVE_INT8);
    for (std::int8_t value = -1; value <= 1; ++value) {
        H5Tenum_insert(type, value < 0 ? "minus" : value > 0 ? "plus" : "none", &value);
    }
    return type;
}

hid_t narrow_type(std::size_t bits) {
    const hid_t type = H5Tcopy(H5T_NATIVE_INT32);
    H5Tset_precision(type, bits);
    return type;
}

hid_t pair_type() {
    const hsize_t two = 2;
    return H5Tarray_create2(H5T_NATIVE_DOUBLE, 1, &two);
}

hid_t any_type(unsigned kind) {
    const std::array plain{H5T_STD_I8BE,   H5T_STD_U8LE,       H5T_STD_I16LE, H5T_STD_I32BE,
                           H5T_STD_U32LE,  H5T_STD_I64BE,      H5T_STD_U64LE, H5T_IEEE_F32BE,
                           H5T_IEEE_F64BE, H5T_NATIVE_LDOUBLE, H5T_STD_B8LE};
    if (kind < plain.size()) return H5Tcopy(plain[kind]);
    using Made = hid_t (*)();
    const std::array<Made, 9> made{[] { return H5Tcreate(H5T_OPAQUE, 5); },
                                   [] { return string_type(6, H5T_CSET_ASCII); },
                                   [] { return string_type(H5T_VARIABLE, H5T_CSET_UTF8); },
                                   compound_type,
                                   enum_type,
                                   [] { return H5Tvlen_create(H5T_NATIVE_INT32); },
                                   pair_type,
                                   [] { return H5Tcopy(H5T_STD_REF_OBJ); },
                                   [] { return narrow_type(13); }};
    kind -= static_cast<unsigned>(plain.size());
    return kind < made.size() ? made[kind]() : H5Tcopy(H5T_UNIX_D32LE);
}

// How a data set is stored: contiguous, in chunks, compressed, within its own header, with a fill value and no data.
hid_t any_storage(Bytes& bytes, int rank) {
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    const unsigned how = bytes.index(8);
    const std::array<hsize_t, 3> chunk{1 + bytes.index(16), 1 + bytes.index(4), 1};
    if (how == 1) H5Pset_layout(properties, H5D_COMPACT);
    if (how >= 2 && rank > 0) H5Pset_chunk(properties, rank, chunk.data());
    if (how == 3) H5Pset_deflate(properties, 6);
    if (how == 4) H5Pset_shuffle(properties);
    if (how == 5) H5Pset_fletcher32(properties);
    if (how == 6) H5Pset_scaleoffset(properties, H5Z_SO_INT, 0);
    if (how == 7) H5Pset_external(properties, "no_such_file.bin", 0, H5F_UNLIMITED);
    return properties;
}

// What a good column holds, in the order of the rows.
struct Values {
    std::vector<double> reals;

    [[nodiscard]] std::vector<std::int64_t> integers() const {
        std::vector<std::int64_t> whole;
        for (const double x : reals) whole.push_back(std::fabs(x) < 1e18 ? static_cast<std::int64_t>(x) : 7);
        return whole;
    }
};

Values values_of(Bytes& bytes, const std::string& column, std::size_t n) {
    Values values;
    for (std::size_t k = 0; k < n; ++k) {
        double value = 1.0;
        if (column == "half" || column == "tick") value = static_cast<double>(k);
        if (column == "bias_sign") value = k % 2 == 0 ? 1.0 : -1.0;
        if (column == "counts") value = 150.0 - static_cast<double>(k);
        if (column == "t_s") value = 0.005 * static_cast<double>(k + 1);
        values.reals.push_back(value);
    }
    while (bytes.index(4) == 3 && n > 0) values.reals[bytes.index(64) % n] = bytes.real(1.0);
    return values;
}

void write_values(hid_t set, hid_t type, const Values& values) {
    const H5T_class_t kind = H5Tget_class(type);
    if (kind == H5T_FLOAT) {
        H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.reals.data());
    } else if (kind == H5T_INTEGER) {
        H5Dwrite(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.integers().data());
    } else if (H5Tis_variable_str(type) <= 0 && kind != H5T_VLEN && kind != H5T_REFERENCE) {
        const std::vector<std::uint8_t> letters(H5Tget_size(type) * values.reals.size(), 'x');
        H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, letters.data());
    }
}

struct Table {
    hid_t group;
    std::size_t n_rows;
};

void add_column(Bytes& bytes, const Table& table, const std::string& name, bool is_real) {
    const unsigned what = bytes.index(32);
    const bool is_good = what < 24;
    const int rank = name.starts_with("light") ? 2 : is_good || what % 4 != 0 ? 1 : static_cast<int>(bytes.index(4));
    const std::size_t n_rows = is_good || what % 4 != 1 ? table.n_rows : bytes.index(64);
    const std::size_t width = rank >= 2 ? 2 : 1;
    const std::array<hsize_t, 3> size{n_rows, width, 1};
    std::array<hsize_t, 3> most = size;
    if (bytes.flag()) most[0] = H5S_UNLIMITED;
    const Id type{is_good || what % 4 != 2 ? H5Tcopy(is_real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64)
                                           : any_type(bytes.index(21))};
    const Id space{rank == 0 ? H5Screate(bytes.flag() ? H5S_SCALAR : H5S_NULL)
                             : H5Screate_simple(rank, size.data(), most.data())};
    const Id storage{any_storage(bytes, rank)};
    const Id set{
        H5Dcreate2(table.group, name.c_str(), type.get(), space.get(), H5P_DEFAULT, storage.get(), H5P_DEFAULT)};
    if (set.get() < 0) return;
    const auto n_values = static_cast<std::size_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space.get())));
    if (bytes.index(16) != 15) write_values(set.get(), type.get(), values_of(bytes, name, n_values));
}

// Something else under the name of a column, or nothing.
void add_stranger(Bytes& bytes, const Table& table, const std::string& name) {
    switch (bytes.index(6)) {
        case 0: (void)Id{H5Gcreate2(table.group, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)}; break;
        case 1: H5Lcreate_soft("half", table.group, name.c_str(), H5P_DEFAULT, H5P_DEFAULT); break;
        case 2: H5Lcreate_soft(name.c_str(), table.group, name.c_str(), H5P_DEFAULT, H5P_DEFAULT); break;
        case 3:
            H5Lcreate_external("good_raw.h5", "/raw/half", table.group, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
            break;
        case 4: H5Lcreate_hard(table.group, "half", table.group, name.c_str(), H5P_DEFAULT, H5P_DEFAULT); break;
        default: break;
    }
}

void add_attribute(Bytes& bytes, hid_t file, const char* name, double good) {
    const unsigned what = bytes.index(16);
    if (what == 0) return;
    const Id type{what < 12 ? H5Tcopy(H5T_NATIVE_DOUBLE) : any_type(bytes.index(21))};
    const hsize_t two = 2;
    const Id space{what % 8 == 7 ? H5Screate_simple(1, &two, nullptr) : H5Screate(H5S_SCALAR)};
    const Id attribute{H5Acreate2(file, name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT)};
    const std::array<double, 2> values{what == 1 ? bytes.real(good) : good, good};
    if (attribute.get() >= 0 && what % 8 != 6) H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, values.data());
}

// /config: text of any bytes, of fixed or variable length, or of another type.
void add_config(Bytes& bytes, hid_t file) {
    const unsigned what = bytes.index(8);
    if (what == 0) return;
    std::string text = "[gyro]\ntick_s = 0.005\n";
    if (what >= 4) {
        for (unsigned n = bytes.index(64); n > 0; --n) text += static_cast<char>(bytes.take<std::uint8_t>());
    }
    const bool is_variable = what % 2 == 0;
    const Id type{what == 3 ? any_type(bytes.index(21))
                            : string_type(is_variable ? H5T_VARIABLE : text.size() + 1,
                                          bytes.flag() ? H5T_CSET_UTF8 : H5T_CSET_ASCII)};
    const Id space{H5Screate(H5S_SCALAR)};
    const Id set{H5Dcreate2(file, "config", type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)};
    const char* const start = text.c_str();
    if (set.get() < 0 || what == 3) return;
    H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
             is_variable ? static_cast<const void*>(&start) : start);
}

struct Column {
    const char* name;
    bool is_real;
};

constexpr std::array raw_columns{Column{"half", false},           Column{"bias_sign", false},
                                 Column{"mode", false},           Column{"counts", false},
                                 Column{"loop_closed", false},    Column{"valid", false},
                                 Column{"detuning_lambda", true}, Column{"detuning_sq_lambda2", true},
                                 Column{"piezo_v", true},         Column{"temperature_c", true},
                                 Column{"light", true},           Column{"light_b", true},
                                 Column{"count", false},          Column{"remark", true}};
constexpr std::array angle_columns{Column{"tick", false},         Column{"t_s", true},
                                   Column{"dtheta_arcsec", true}, Column{"dtheta_final_arcsec", true},
                                   Column{"sigma_arcsec", true},  Column{"mode", false},
                                   Column{"flags", false},        Column{"remark", true}};

template <std::size_t size>
void add_table(Bytes& bytes, hid_t file, const char* name, const std::array<Column, size>& columns,
               std::size_t n_rows) {
    const Id group{H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)};
    for (const Column& column : columns) {
        // What no log should have is there rarely.
        const bool is_strange = std::strcmp(column.name, "count") == 0 || std::strcmp(column.name, "remark") == 0;
        const unsigned what = bytes.index(64);
        if (is_strange && what < 60) continue;
        if (what >= 62) {
            add_stranger(bytes, {group.get(), n_rows}, column.name);
        } else if (what < 60 || is_strange) {
            add_column(bytes, {group.get(), n_rows}, column.name, column.is_real);
        }
    }
}

void build(Bytes& bytes, const std::string& path) {
    const Id access{H5Pcreate(H5P_FILE_ACCESS)};
    if (bytes.flag()) H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    const Id file{H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get())};
    const unsigned kind = bytes.index(8);
    const std::size_t n_rows = bytes.index(40);
    if (kind != 0) add_attribute(bytes, file.get(), "format_version", 1.0);
    add_attribute(bytes, file.get(), "tick_s", 0.005);
    add_attribute(bytes, file.get(), "scale_arcsec", 3.263);
    add_config(bytes, file.get());
    if (kind < 5) add_table(bytes, file.get(), "raw", raw_columns, n_rows);
    if (kind >= 4) add_table(bytes, file.get(), "angles", angle_columns, n_rows);
    if (kind == 7) add_table(bytes, file.get(), "truth", std::array{Column{"dtheta_arcsec", true}}, n_rows);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // What the library cannot build is no fault of ours: it stays out of the file, in silence.
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    fuzz::claim_nothing_is_open();
    fuzz::Bytes bytes{data, size};
    const std::string path = fuzz::scratch().path("built.h5");
    build(bytes, path);
    fuzz::claim_log(path);
    fuzz::claim_nothing_is_open();
    return 0;
}
