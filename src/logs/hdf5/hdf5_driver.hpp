#pragma once
// What our drivers of the HDF5 library share: a file that stands for a `Subject`, a plain value which says where its
// bytes are.

#include <algorithm>
#include <new>
#include <zlg/logs/error.hpp>

#include "file_descriptor.hpp"
#include "hdf5_handle.hpp"

namespace zlg::logs::hdf5 {

inline constexpr haddr_t max_address = (haddr_t{1} << 62) - 1;

// What the library hands to every call of the driver; its own part comes first.
template <class Subject> struct DriverFile {
    H5FD_t library_part;
    Subject subject;
    haddr_t end_of_allocation;

    static DriverFile& of(H5FD_t* file) { return *reinterpret_cast<DriverFile*>(file); }
    static const DriverFile& of(const H5FD_t* file) { return *reinterpret_cast<const DriverFile*>(file); }
};

// A driver that opens and closes files; how they are read and written is left to be filled in.
template <class Subject> H5FD_class_t driver_of(const char* name, H5F_close_degree_t close_degree) {
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
template <class Subject> Handle access_of(hid_t driver, const Subject& subject) {
    Handle access{H5Pcreate(H5P_FILE_ACCESS), &H5Pclose};
    if (driver < 0 || H5Pset_driver(access.get(), driver, &subject) < 0)
        throw IoError("the HDF5 library refuses the driver of a log: " + last_failure().reason);
    return access;
}

// How the HDF5 library reads a log: nothing is made up for what the file does not hold.
//
// The library's own driver hands out zeros behind the end of a file, and of a growing log it does not ask where the end
// is. A log whose tail was lost would read as zeros.
//
// return  file access properties: reads `fd`, which must outlive the file, and fails for rows behind its end.
// Structures
//         of the library are still filled up with zeros, since it reads them ahead; they have checksums.
[[nodiscard]] Handle access_to_read(int fd);

}  // namespace zlg::logs::hdf5
