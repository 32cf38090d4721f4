// The reader of CSV logs alone, without the library of HDF5, which is larger than the lab page: a log in HDF5 is
// refused. So is a file of another program that is no text, before its reader would be asked.
#include <fmt/format.h>

#include <zlg/logs/error.hpp>

#include "foreign/foreign_readers.hpp"
#include "log_io.hpp"

namespace zlg::logs {
namespace {

[[noreturn]] void refuse_hdf5(const std::string& path) {
    throw FormatError{fmt::format(
        "{}: is an HDF5 log; the page reads CSV, of which `zlg convert {} --out log.csv` makes one", path, path)};
}

}  // namespace

std::unique_ptr<LogSource<RawTable>> open_raw_hdf5(const std::string& path) { refuse_hdf5(path); }
std::unique_ptr<LogSource<AngleTable>> open_angle_hdf5(const std::string& path) { refuse_hdf5(path); }

ForeignTable hdf5_table_of(const std::string& path, const Mapping&) { refuse_hdf5(path); }
ForeignTable matlab5_table_of(const std::string& path, const Mapping&) { refuse_hdf5(path); }
ForeignTable bag_table_of(const std::string& path, const Mapping&) { refuse_hdf5(path); }
ForeignTable numpy_table_of(const std::string& path) { refuse_hdf5(path); }
ForeignTable doubles_table_of(const std::string& path) { refuse_hdf5(path); }

}  // namespace zlg::logs
