#pragma once
// HDF5 files as other programs write them, made with the library itself.

#if __has_include(<hdf5.h>)
#include <hdf5.h>
#else
#include <hdf5/serial/hdf5.h>

#include "test.hpp"
#endif

namespace zlg::test {

class Hdf5File {
public:
    explicit Hdf5File(const std::string& path, bool existing = false)
        : file_{existing ? H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT)
                         : H5Fcreate(path.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, H5P_DEFAULT)} {
        if (file_ < 0) throw std::runtime_error("cannot make " + path);
    }
    ~Hdf5File() { H5Fclose(file_); }
    Hdf5File(const Hdf5File&) = delete;

    [[nodiscard]] hid_t id() const { return file_; }

    Hdf5File& group(const std::string& path) {
        H5Gclose(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
        return *this;
    }

    // A data set of the given type in the file; `chunk` 0: in one piece; `deflate` as in gzip.
    template <class T>
    Hdf5File& column(const std::string& path, const std::vector<T>& values, hid_t type = hdf5_type<T>(),
                     hsize_t chunk = 0, unsigned deflate = 0) {
        return table(path, values, {values.size()}, type, chunk, deflate);
    }

    template <class T>
    Hdf5File& table(const std::string& path, const std::vector<T>& values, const std::vector<hsize_t>& size,
                    hid_t type = hdf5_type<T>(), hsize_t chunk = 0, unsigned deflate = 0) {
        const hid_t space = H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr);
        const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
        if (chunk > 0) H5Pset_chunk(creation, 1, &chunk);
        if (deflate > 0) H5Pset_deflate(creation, deflate);
        const hid_t set = H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
        H5Dwrite(set, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        H5Dclose(set);
        H5Pclose(creation);
        H5Sclose(space);
        return *this;
    }

    Hdf5File& text(const std::string& path, const std::string& text) {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, text.size() + 1);
        const hid_t space = H5Screate(H5S_SCALAR);
        const hid_t set = H5Dcreate2(file_, path.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
        H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str());
        H5Dclose(set);
        H5Sclose(space);
        H5Tclose(type);
        return *this;
    }

    // A text of C, with a zero behind it, into the place of another.
    Hdf5File& overwrite_text(const std::string& path, const std::string& text) {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, text.size() + 1);
        const hid_t set = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
        H5Tset_cset(type, H5T_CSET_UTF8);
        if (H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) < 0)
            throw std::runtime_error("cannot write " + path);
        H5Dclose(set);
        H5Tclose(type);
        return *this;
    }

    Hdf5File& attribute(const std::string& name, double value) {
        return attribute(name, H5T_NATIVE_DOUBLE, H5Screate(H5S_SCALAR), &value);
    }
    Hdf5File& attributes(const std::string& name, const std::vector<double>& values) {
        const hsize_t size = values.size();
        return attribute(name, H5T_NATIVE_DOUBLE, H5Screate_simple(1, &size, nullptr), values.data());
    }
    Hdf5File& text_attribute(const std::string& name, const std::string& text) {
        const hid_t type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, text.size());
        attribute(name, type, H5Screate(H5S_SCALAR), text.c_str());
        H5Tclose(type);
        return *this;
    }

    Hdf5File& remove(const std::string& path) {
        H5Ldelete(file_, path.c_str(), H5P_DEFAULT);
        return *this;
    }

private:
    Hdf5File& attribute(const std::string& name, hid_t type, hid_t space, const void* value) {
        const hid_t attribute = H5Acreate2(file_, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT);
        H5Awrite(attribute, type, value);
        H5Aclose(attribute);
        H5Sclose(space);
        return *this;
    }

    template <class T> static hid_t hdf5_type() {
        if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
        if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
        if constexpr (std::is_same_v<T, int>) return H5T_NATIVE_INT;
        if constexpr (std::is_same_v<T, std::int64_t>) return H5T_NATIVE_INT64;
        if constexpr (std::is_same_v<T, std::uint64_t>) return H5T_NATIVE_UINT64;
    }

    hid_t file_;
};

}  // namespace zlg::test
