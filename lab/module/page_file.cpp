// The one file that the page has given to the module, in place of a file system: the page answers what the C library
// asks of the number `page_file` (fd_read, fd_pread, fd_filestat_get of WASI), whatever name it is opened by.

#include <cerrno>
#include <cstdarg>
#include <cstdio>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

constexpr int page_file = 3;  // the first number after standard input, output and error

}  // namespace

// Both take the place of the C library's (the linker's --wrap). The file is read from its beginning.
extern "C" int __wrap_open(const char*, int, ...) {
    ::lseek(page_file, 0, SEEK_SET);
    return page_file;
}

// Nothing is known of a name alone.
extern "C" int __wrap_stat(const char*, struct stat*) {
    errno = ENOENT;
    return -1;
}

// Only fmt's hexadecimal reals and the last words of an abort would come here: no message of ours has the former, and
// nobody hears the latter.
extern "C" int __wrap_snprintf(char*, std::size_t, const char*, ...) { __builtin_trap(); }
extern "C" int __wrap_vfprintf(FILE*, const char*, va_list) { return 0; }
