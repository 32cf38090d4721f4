#include "hdf5_table_writer.hpp"

#include <array>
#include <zlg/logs/error.hpp>

namespace zlg::logs::hdf5 {

namespace {

constexpr std::size_t no_cache = 0;  // rows come in blocks already, so a cache of chunks would only copy them

// While it lives, groups that the library makes by its own default list have no times either: the object that describes
// paged allocation is made so, and its time alone would tell two files of the same rows apart.
class NoDefaultTimes {
public:
    NoDefaultTimes() {
        H5Pget_obj_track_times(H5P_GROUP_CREATE_DEFAULT, &before_);
        H5Pset_obj_track_times(H5P_GROUP_CREATE_DEFAULT, false);
    }
    ~NoDefaultTimes() { H5Pset_obj_track_times(H5P_GROUP_CREATE_DEFAULT, before_); }
    NoDefaultTimes(const NoDefaultTimes&) = delete;
    NoDefaultTimes& operator=(const NoDefaultTimes&) = delete;

private:
    hbool_t before_ = true;
};

}  // namespace

TableWriter::TableWriter(const std::string& path, bool force, bool keep_part)
    : part_{path, force}, storage_{part_.fd()}, keep_part_{keep_part} {
    keep_quiet();
    const Handle access = access_to(storage_);
    const Handle creation = creation_of(H5P_FILE_CREATE);
    // A killed process ends a write of the system between two pages of memory, so what describes the columns must not
    // cross a page: the library's paged aggregation keeps each object within one.
    constexpr hsize_t page_bytes = 4096;
    H5Pset_file_space_strategy(creation.get(), H5F_FSPACE_STRATEGY_PAGE, false, 1);
    H5Pset_file_space_page_size(creation.get(), page_bytes);
    const NoDefaultTimes no_times;
    file_ = {H5Fcreate(part_.part().c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), &H5Fclose};
    if (!file_.is_open()) fail("create");
}

// A log that was not closed must not look like one that was: the library's closing marks would make it complete. What
// holds no row holds nothing worth keeping.
TableWriter::~TableWriter() {
    if (is_open() && keep_part_ && is_started_) {
        try {
            flush();
        } catch (const IoError&) {
            // What was appended before stays readable, and nobody is left to be informed.
        }
    }
    storage_.stop();
    columns_.clear();
    file_.close();
    if (keep_part_ && is_started_ && rows_ > 0) part_.keep();
}

void TableWriter::fail(const char* what) const {
    if (storage_.error() != 0) fail_io(what, part_.part(), storage_.error());
    throw IoError(fmt::format("cannot {} {}: {}", what, part_.part(), last_failure().reason));
}

void TableWriter::refuse_closed() const { throw IoError(fmt::format("cannot write {}: it is closed", part_.part())); }

void TableWriter::add_group(const std::string& path) {
    constexpr unsigned many_links = 32;  // up to here the names stand in the group itself, with no index beside it
    const Handle creation = creation_of(H5P_GROUP_CREATE);
    H5Pset_link_phase_change(creation.get(), many_links, many_links / 2);
    const Handle group{H5Gcreate2(file_.get(), path.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), &H5Gclose};
    if (!group.is_open()) fail("create");
}

void TableWriter::add_column(const std::string& path, const char* unit, Column&& added) {
    const hsize_t width = added.width;
    const int rank = width > 0 ? 2 : 1;
    const std::array<hsize_t, 2> size{0, width};
    const std::array<hsize_t, 2> limit{H5S_UNLIMITED, width};
    const std::array<hsize_t, 2> chunk{block_rows, width};
    const Handle space{H5Screate_simple(rank, size.data(), limit.data()), &H5Sclose};
    const Handle creation = creation_of(H5P_DATASET_CREATE);
    H5Pset_chunk(creation.get(), rank, chunk.data());
    const Handle access{H5Pcreate(H5P_DATASET_ACCESS), &H5Pclose};
    H5Pset_chunk_cache(access.get(), H5D_CHUNK_CACHE_NSLOTS_DEFAULT, no_cache, H5D_CHUNK_CACHE_W0_DEFAULT);
    added.set = {
        H5Dcreate2(file_.get(), path.c_str(), added.type, space.get(), H5P_DEFAULT, creation.get(), access.get()),
        &H5Dclose};
    if (!added.set.is_open()) fail("create");
    columns_.push_back(std::move(added));
    set_text(path, "unit", unit);
}

void TableWriter::add_text(const std::string& path, const std::string& text) {
    const Handle type = text_type(std::max<std::size_t>(text.size(), 1));
    const Handle creation = creation_of(H5P_DATASET_CREATE);
    const Handle set{
        H5Dcreate2(file_.get(), path.c_str(), type.get(), scalar().get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
        &H5Dclose};
    if (!set.is_open() || H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) < 0) {
        fail("write");
    }
}

// Space for the text was allotted when it was added: nothing that describes the file changes, as SWMR demands.
void TableWriter::overwrite_text(const std::string& path, const std::string& text) {
    require_open();
    const Handle type = text_type(text.size());
    const Handle set{H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), &H5Dclose};
    if (!set.is_open() || H5Dwrite(set.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) < 0) {
        fail("write");
    }
    check_storage();
}

void TableWriter::set_text(const std::string& object, const char* name, const std::string& text) {
    // Text of variable length is what readers in other languages hand out as text.
    const Handle type = text_type(H5T_VARIABLE);
    const Handle attribute{H5Acreate_by_name(file_.get(), object.c_str(), name, type.get(), scalar().get(), H5P_DEFAULT,
                                             H5P_DEFAULT, H5P_DEFAULT),
                           &H5Aclose};
    const char* const letters = text.c_str();
    if (!attribute.is_open() || H5Awrite(attribute.get(), type.get(), &letters) < 0) fail("write");
}

void TableWriter::set_number(const char* name, hid_t file_type, hid_t type, const void* value) {
    const Handle attribute{H5Acreate2(file_.get(), name, file_type, scalar().get(), H5P_DEFAULT, H5P_DEFAULT),
                           &H5Aclose};
    if (!attribute.is_open() || H5Awrite(attribute.get(), type, value) < 0) fail("write");
}

void TableWriter::start() {
    if (H5Fstart_swmr_write(file_.get()) < 0 || H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) < 0) fail("write");
    storage_.publish();
    check_storage();
    is_started_ = true;
}

void TableWriter::check_storage() {
    if (storage_.error() != 0) fail_io("write", part_.part(), storage_.error());
}

void TableWriter::extend(const Column& column, std::size_t n) {
    const int rank = column.width > 0 ? 2 : 1;
    const std::array<hsize_t, 2> size{rows_ + n, column.width};
    const std::array<hsize_t, 2> start{rows_, 0};
    const std::array<hsize_t, 2> count{n, column.width};
    if (H5Dset_extent(column.set.get(), size.data()) < 0) fail("write");
    const Handle rows{H5Dget_space(column.set.get()), &H5Sclose};
    const Handle block{H5Screate_simple(rank, count.data(), nullptr), &H5Sclose};
    H5Sselect_hyperslab(rows.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
    if (H5Dwrite(column.set.get(), column.type, block.get(), rows.get(), H5P_DEFAULT, column.buffer) < 0) fail("write");
}

// The numbers of all columns go before the first new length: a row that can be seen is whole.
void TableWriter::append(std::size_t n) {
    check_storage();
    for (const Column& column : columns_) extend(column, n);
    check_storage();
    for (const Column& column : columns_) {
        if (H5Dflush(column.set.get()) < 0) fail("write");
    }
    check_storage();
    if (rows_ == 0 && keep_part_) part_.keep_if_abandoned();
    rows_ += n;
}

void TableWriter::flush() {
    require_open();
    const std::size_t n = std::exchange(n_, 0);
    if (n > 0) append(n);
    room_ = block_rows - rows_ % block_rows;
}

void TableWriter::close() {
    flush();
    columns_.clear();
    const bool closed = file_.close();
    try {
        check_storage();
        if (!closed) fail("write");
    } catch (const IoError&) {
        if (keep_part_ && rows_ > 0) {
            part_.keep();
        } else {
            part_.discard();
        }
        throw;
    }
    part_.complete(keep_part_);
}

}  // namespace zlg::logs::hdf5
