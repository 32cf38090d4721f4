#include "hdf5_storage.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <zlg/logs/error.hpp>

#include "file_descriptor.hpp"
#include "hdf5_driver.hpp"

namespace zlg::logs::hdf5 {

namespace {

// The superblock stands first in the file; without its signature nobody takes the file for a log.
constexpr std::size_t superblock_bytes = 48;

using File = DriverFile<Storage*>;

herr_t query(const H5FD_t*, unsigned long* flags) {
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_SUPPORTS_SWMR_IO | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
    return 0;
}

haddr_t get_eof(const H5FD_t* file, H5FD_mem_t) { return File::of(file).subject->end(); }

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, void* buffer) try {
    return File::of(file).subject->read(address, size, buffer) ? 0 : -1;
} catch (...) {
    return -1;
}

herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, size_t size, const void* buffer) try {
    File::of(file).subject->write(address, size, buffer);
    return 0;
} catch (...) {
    return -1;
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) try {
    File::of(file).subject->resize(File::of(file).end_of_allocation);
    return 0;
} catch (...) {
    return -1;
}

// PATH.part is made for one writer by O_EXCL, and readers of a SWMR file need no lock. But only for a driver that has
// these calls does the library mark the file as open.
herr_t lock(H5FD_t*, hbool_t) { return 0; }
herr_t unlock(H5FD_t*) { return 0; }

hid_t register_driver() {
    H5FD_class_t driver = driver_of<Storage*>("zlg log", H5F_CLOSE_STRONG);
    driver.query = &query;
    driver.get_eof = &get_eof;
    driver.read = &read;
    driver.write = &write;
    driver.truncate = &truncate;
    driver.lock = &lock;
    driver.unlock = &unlock;
    return H5FDregister(&driver);
}

}  // namespace

void Storage::publish() {
    const std::size_t head = std::min(superblock_bytes, image_.size());
    const std::string_view image{image_.data(), image_.size()};
    error_ = write_all(fd_, image.substr(head), head).error;
    if (error_ == 0) error_ = write_all(fd_, image.substr(0, head), 0).error;
    // What did not reach the file goes on in memory, for the library reads it again when it closes.
    if (error_ != 0) return;
    staged_ = false;
    image_ = {};
}

void Storage::stop() {
    if (error_ == 0) error_ = ECANCELED;
}

bool Storage::read(haddr_t address, size_t size, void* buffer) {
    char* const bytes = static_cast<char*>(buffer);
    std::memset(bytes, 0, size);
    if (staged_) {
        if (address < image_.size()) std::memcpy(bytes, &image_[address], std::min(size, image_.size() - address));
        return true;
    }
    const bool good = read_at(fd_, address, size, bytes) >= 0;
    for (const auto& [begin, lost] : lost_) {
        const haddr_t from = std::max(begin, address);
        const haddr_t to = std::min(begin + lost.size(), address + size);
        if (from < to) std::memcpy(bytes + (from - address), lost.data() + (from - begin), to - from);
    }
    return good;
}

void Storage::write(haddr_t address, size_t size, const void* buffer) {
    const char* const bytes = static_cast<const char*>(buffer);
    end_ = std::max(end_, address + size);
    if (staged_) {
        if (image_.size() < address + size) image_.resize(address + size);
        std::memcpy(&image_[address], bytes, size);
        return;
    }
    if (error_ == 0) error_ = write_all(fd_, {bytes, size}, address).error;
    if (error_ == 0) return;
    // A later write to the same place is the valid one, whatever its size.
    for (auto& [begin, lost] : lost_) {
        const haddr_t from = std::max(begin, address);
        const haddr_t to = std::min(begin + lost.size(), address + size);
        if (from < to) std::memcpy(lost.data() + (from - begin), bytes + (from - address), to - from);
    }
    auto& lost = lost_[address];
    if (lost.size() < size) lost.assign(bytes, bytes + size);
}

void Storage::resize(haddr_t size) {
    end_ = size;
    if (staged_) {
        image_.resize(size);
    } else if (error_ == 0 && ::ftruncate(fd_, static_cast<off_t>(size)) != 0) {
        error_ = errno;
    }
}

Handle access_to(Storage& storage) {
    static const hid_t driver = register_driver();
    Handle access = access_of(driver, &storage);
    if (H5Pset_libver_bounds(access.get(), H5F_LIBVER_LATEST, H5F_LIBVER_LATEST) < 0)
        throw IoError("the HDF5 library refuses the format of a growing log: " + last_failure().reason);
    return access;
}

}  // namespace zlg::logs::hdf5
