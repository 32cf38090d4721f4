#pragma once
// What our drivers of the HDF5 library share: a file that stands for a `Subject`, a plain value which says where its
// bytes are.

#include <sys/types.h>

#include <algorithm>
#include <new>
#include <zlg/logs/error.hpp>

#include "hdf5_handle.hpp"

namespace zlg::logs::hdf5 {

inline constexpr haddr_t max_address = (haddr_t{1} << 62) - 1;

// What the library hands to every call of the driver; its own part comes first.
template <class Subject>
struct DriverFile {
    H5FD_t library_part;
    Subject subject;
    haddr_t end_of_allocation;

    static DriverFile& of(H5FD_t* file) { return *reinterpret_cast<DriverFile*>(file); }
    static const DriverFile& of(const H5FD_t* file) { return *reinterpret_cast<const DriverFile*>(file); }
};

// A driver that opens and closes files; how they are read and written is left to be filled in.
template <class Subject>
H5FD_class_t driver_of(const char* name, H5F_close_degree_t close_degree) {
    using File = DriverFile<Subject>;
    H5FD_class_t driver{};
#ifdef H5FD_CLASS_VERSION  // since HDF5 1.14, which knows its own drivers by low numbers
    driver.version = H5FD_CLASS_VERSION;
    driver.value = H5_VFD_MAX;
#endif
    driver.name = name;
    driver.maxaddr = max_address;
    driver.fc_degree = close_degree;
    driver.fapl_size = sizeof(Subject);
    driver.open = [](const char*, unsigned, hid_t access, haddr_t) {
        const auto* subject = static_cast<const Subject*>(H5Pget_driver_info(access));
        File* file = subject != nullptr ? new (std::nothrow) File{} : nullptr;
        if (file != nullptr) file->subject = *subject;
        return reinterpret_cast<H5FD_t*>(file);
    };
    driver.close = [](H5FD_t* file) -> herr_t {
        delete &File::of(file);
        return 0;
    };
    driver.get_eoa = [](const H5FD_t* file, H5FD_mem_t) { return File::of(file).end_of_allocation; };
    driver.set_eoa = [](H5FD_t* file, H5FD_mem_t, haddr_t address) -> herr_t {
        File::of(file).end_of_allocation = address;
        return 0;
    };
    constexpr H5FD_mem_t kinds[H5FD_MEM_NTYPES] = H5FD_FLMAP_DICHOTOMY;
    std::ranges::copy(kinds, driver.fl_map);
    return driver;
}

// File access properties for a file of the subject. errors  IoError.
template <class Subject>
Handle access_of(hid_t driver, const Subject& subject) {
    Handle access{H5Pcreate(H5P_FILE_ACCESS), &H5Pclose};
    if (driver < 0 || H5Pset_driver(access.get(), driver, &subject) < 0)
        throw IoError("the HDF5 library refuses the driver of a log: " + last_failure().reason);
    return access;
}

// Reads up to `size` bytes; the number of those before the end of the file, or -1.
ssize_t read_at(int fd, haddr_t address, size_t size, void* buffer);

}  // namespace zlg::logs::hdf5
