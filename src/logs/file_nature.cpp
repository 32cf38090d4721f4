#include <zlg/logs/file_nature.hpp>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <zlg/logs/error.hpp>
#include <zlg/text/spelling.hpp>

#include "file_descriptor.hpp"

namespace zlg::logs {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n"sv;

// Whoever reads it as text says where it is none.
constexpr const char* unknown_nature = "a binary file";

struct Signature {
    std::string_view bytes;
    const char* nature;
};

constexpr std::array signatures{
    Signature{"\x93NUMPY"sv, "a NumPy array (.npy)"},
    Signature{"MATLAB 5.0 MAT-file"sv, "a MATLAB 5 file (.mat)"},
    Signature{"ULog\x01\x12\x35"sv, "a ULog of PX4 (.ulg); ulog2csv of pyulog makes text of it"},
    Signature{"RDX"sv, "data of R (.rda)"},
    Signature{"PK\x03\x04"sv, "a ZIP archive, as .npz, .xlsx and .ods are"},
    Signature{"\x1f\x8b"sv, "compressed with gzip"},
    Signature{"BZh"sv, "compressed with bzip2"},
    Signature{"\xfd"
              "7zXZ"sv,
              "compressed with xz"},
    Signature{"\x28\xb5\x2f\xfd"sv, "compressed with zstd"},
    Signature{"\xd0\xcf\x11\xe0"sv, "an Excel file of the old format (.xls)"},
    Signature{"\xff\xfe"sv, "text in UTF-16; save it as UTF-8"},
    Signature{"\xfe\xff"sv, "text in UTF-16; save it as UTF-8"},
    Signature{"SQLite format 3"sv, "an SQLite database, as ROS 2 bags (.db3) are"},
    Signature{"PAR1"sv, "a Parquet file"},
    Signature{"ARROW1"sv, "an Arrow file"},
    Signature{"CDF\x01"sv, "a netCDF file"},
    Signature{"CDF\x02"sv, "a netCDF file"},
    Signature{"TDSm"sv, "a TDMS file of LabVIEW"},
    Signature{"#ROSBAG"sv, "a ROS bag"},
    Signature{"\x89MCAP"sv, "an MCAP file"},
    Signature{"%PDF"sv, "a PDF"},
    Signature{"\x89PNG"sv, "a PNG picture"},
};

struct Head {
    std::array<char, 8192> bytes{};
    std::size_t n = 0;
    std::int64_t size = 0;

    [[nodiscard]] std::string_view text() const { return {bytes.data(), n}; }
};

bool is_regular(const std::string& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) != 0 || S_ISREG(status.st_mode);
}

Head head_of(int file, const std::string& path) {
    Head head;
    struct stat status {};
    if (::fstat(file, &status) == 0) head.size = status.st_size;
    const ssize_t n = ::pread(file, head.bytes.data(), head.bytes.size(), 0);
    if (n < 0) fail_io("read", path, errno);
    head.n = static_cast<std::size_t>(n);
    return head;
}

// Numbers of a measurement, none of them as far from 1 as chance makes them.
template <class Real> bool are_reals(const Head& head) {
    if (head.size % static_cast<std::int64_t>(sizeof(Real)) != 0 || head.n < 2 * sizeof(Real)) return false;
    std::size_t n_zero = 0;
    const std::size_t n = head.n / sizeof(Real);
    for (std::size_t k = 0; k < n; ++k) {
        Real value;
        std::memcpy(&value, head.bytes.data() + k * sizeof(Real), sizeof value);
        const auto size = static_cast<double>(std::fabs(value));
        if (value == Real{0})
            ++n_zero;
        else if (!(size > 1e-18 && size < 1e15))
            return false;
    }
    return n_zero < n;
}

// How many numbers make a row, where the first of each rises evenly; 0 where none does.
std::size_t doubles_to_a_row(const Head& head) {
    const std::size_t n = head.n / sizeof(double);
    const auto at = [&head](std::size_t k) {
        double value;
        std::memcpy(&value, head.bytes.data() + k * sizeof value, sizeof value);
        return value;
    };
    for (std::size_t width = 2; width <= 40 && 4 * width < n; ++width) {
        const double step = at(width) - at(0);
        bool even = step > 0.0;
        for (std::size_t k = width; even && k + width < n; k += width)
            even = std::fabs(at(k + width) - at(k) - step) <= 0.05 * step;
        if (even) return width;
    }
    return 0;
}

std::string nature_of_bytes(const Head& head) {
    if (are_reals<double>(head)) {
        const std::size_t width = doubles_to_a_row(head);
        return fmt::format("binary numbers of 8 bytes without a header, by the look of them{}",
                           width > 0 ? fmt::format(" {} to a row, the first of which rises evenly", width) : "");
    }
    if (are_reals<float>(head)) return "binary numbers of 4 bytes without a header, by the look of them";
    return unknown_nature;
}

}  // namespace

long long hdf5_offset(int open_file, const std::string& path) {
    struct stat status {};
    if (::fstat(open_file, &status) != 0) return -1;
    for (long long offset = 0; offset < status.st_size; offset = offset == 0 ? 512 : 2 * offset) {
        std::array<char, hdf5_signature.size()> start{};
        const ssize_t n = ::pread(open_file, start.data(), start.size(), offset);
        if (n < 0) fail_io("read", path, errno);
        if (std::string_view{start.data(), static_cast<std::size_t>(n)} == hdf5_signature) return offset;
    }
    return -1;
}

bool has_hdf5_signature(const std::string& path) {
    return is_regular(path) && hdf5_offset(open_to_read(path).get(), path) >= 0;
}

std::string foreign_nature(const std::string& path) {
    if (!is_regular(path)) return {};
    const FileDescriptor file = open_to_read(path);
    const Head head = head_of(file.get(), path);
    const long long offset = hdf5_offset(file.get(), path);
    if (offset > 0)
        return fmt::format("HDF5 with a user block of {} bytes{}", offset,
                           head.text().starts_with("MATLAB 7.3") ? ", a MATLAB 7.3 file (.mat)" : "");
    if (offset == 0) return "HDF5";
    // Without the library of files, which the page's module does not have.
    const std::string suffix = zlg::text::lower_case(path.substr(std::min(path.rfind('.'), path.size())));
    for (const Signature& signature : signatures) {
        if (!head.text().starts_with(signature.bytes)) continue;
        if (suffix == ".xlsx" || suffix == ".ods") return "a table of a spreadsheet (" + suffix + "); save it as CSV";
        if (suffix == ".rda" || suffix == ".rdata")
            return std::string{"data of R ("} + suffix + "); write.csv makes text of it";
        return signature.nature;
    }
    return head.text().find('\0') == std::string_view::npos ? std::string{} : nature_of_bytes(head);
}

void refuse_foreign(const std::string& path) {
    const std::string nature = foreign_nature(path);
    if (nature.empty() || nature == unknown_nature) return;
    const char* allowed =
        nature.starts_with("HDF5") ? "a log, with /raw or /angles in it, or a text file" : "a text file";
    const bool imports = nature.starts_with("HDF5") || nature.starts_with("a MATLAB 5") ||
                         nature.starts_with("a NumPy") || nature.starts_with("binary numbers of 8") ||
                         nature.starts_with("a ROS bag") || nature.starts_with("an MCAP");
    throw FormatError(
        fmt::format("{}: is {}; allowed is {}{}", path, nature, allowed, imports ? "; zlg import reads this one" : ""));
}

}  // namespace zlg::logs
