// An HDF5 file of another program in which some bytes were changed. Of the earliest version of the format, whose object
// headers have no checksum, it is read as it is: libhdf5 1.10 itself reads beyond its buffers where such a header is
// damaged.

#include <hdf5.h>

#include <cmath>

#include "foreign_claims.hpp"
#include "hdf5_objects.hpp"
#include "spoilt.hpp"

namespace {

using namespace zlg;

constexpr hsize_t n_rows = 40;

void add(hid_t file, const char* name, hid_t type, hid_t creation, hsize_t columns, double slope) {
    const hsize_t size[2] = {n_rows, columns};
    const hid_t space = H5Screate_simple(columns > 1 ? 2 : 1, size, nullptr);
    const hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    std::vector<double> values;
    for (hsize_t k = 0; k < n_rows * columns; ++k)
        values.push_back(slope > 0.0 ? slope * static_cast<double>(k)
                                     : std::round(9.0 * std::sin(static_cast<double>(k))));
    H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    const hid_t scalar = H5Screate(H5S_SCALAR);
    const hid_t attribute = H5Acreate2(set, "scale", H5T_NATIVE_DOUBLE, scalar, H5P_DEFAULT, H5P_DEFAULT);
    const double one = 1.0;
    H5Awrite(attribute, H5T_NATIVE_DOUBLE, &one);
    H5Aclose(attribute);
    H5Sclose(scalar);
    H5Dclose(set);
    H5Sclose(space);
}

// Of either version of the format: contiguous, packed, of two dimensions, of whole numbers, in a group, with a link
// back.
std::vector<std::uint8_t> good_file(bool latest) {
    const std::string path = fuzz::scratch().path("good.h5");
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    if (latest) H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
    const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
    const hid_t group = H5Gcreate2(file, "g", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t packed = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk[2] = {16, 2};
    H5Pset_chunk(packed, 2, chunk);
    H5Pset_deflate(packed, 6);
    add(file, "t_s", H5T_IEEE_F64LE, H5P_DEFAULT, 1, 0.01);
    add(file, "w", H5T_IEEE_F32LE, H5P_DEFAULT, 1, 0.0);
    add(file, "counts", H5T_STD_I64BE, H5P_DEFAULT, 1, 0.0);
    add(file, "g/x", H5T_IEEE_F64LE, packed, 3, 0.0);
    H5Lcreate_hard(file, "/", group, "root", H5P_DEFAULT, H5P_DEFAULT);
    H5Pclose(packed);
    H5Gclose(group);
    H5Fclose(file);
    H5Pclose(access);
    return fuzz::content(path);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::vector<std::uint8_t> earliest = good_file(false), latest = good_file(true);
    fuzz::claim_nothing_is_open();
    fuzz::Bytes bytes{data, size};
    const logs::Mapping mapping = fuzz::any_mapping(bytes);
    const bool is_latest = bytes.flag();
    std::vector<std::uint8_t> file = is_latest ? latest : earliest;
    while (is_latest && !bytes.empty()) fuzz::spoil(bytes, file);
    const std::string path = fuzz::scratch().write("foreign.h5", file.data(), file.size());
    try {
        fuzz::claim_foreign(path, mapping);
    } catch (const logs::IoError&) {
        // What is said to lie behind the end of the file.
    }
    fuzz::claim_nothing_is_open();
    return 0;
}
