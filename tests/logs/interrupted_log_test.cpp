// Claims about an HDF5 log that was never closed or has lost a part: what it still holds is read, and nothing is made
// up.
#include <sys/wait.h>
#include <unistd.h>

#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/raw_log.hpp>

#include "hdf5_file.hpp"
#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;
using zlg::core::HalfRecord;
namespace fs = std::filesystem;

namespace {

constexpr RawWriterOptions keep_unfinished{.light_samples = 4, .keep_part = true};

// No column of it is ever zero, but for the first index.
HalfRecord row_without_zero(std::int64_t half) {
    const auto x = static_cast<double>(half);
    return {.half = half,
            .counts = 151 - 302 * (half % 2),
            .detuning_lambda = 1e-3 * (1.5 + std::sin(x)),
            .detuning_sq_lambda2 = 1e-4 * (1.0 + x),
            .piezo_v = 150.0 + x,
            .temperature_c = 20.0 + x,
            .bias_sign = static_cast<std::int8_t>(half % 2 == 0 ? 1 : -1),
            .mode = 1,
            .loop_closed = true,
            .valid = true};
}

std::array<float, 4> light_without_zero(std::int64_t half) {
    const auto x = static_cast<float>(half % 1000) + 0.25f;
    return {x, x, x, x};
}

void write_rows(RawWriter& writer, std::int64_t n) {
    for (std::int64_t half = 0; half < n; ++half) writer.write(row_without_zero(half), {light_without_zero(half)});
}

struct Found {
    std::int64_t rows = 0;
    bool complete = false;
    std::string complaint;  // empty: the end of the file
};

// What a reader hands out; a failure when a row is not the one that was written.
Found read_all(const std::string& path) {
    Found found;
    try {
        RawReader reader{path};
        found.complete = reader.header().complete;
        for (HalfRecord row; reader.next(row); ++found.rows) {
            const auto light = light_without_zero(found.rows);
            if (row == row_without_zero(found.rows) && std::ranges::equal(reader.light().a, light)) continue;
            ADD_FAILURE() << path << ": row " << found.rows << " is another";
            return found;
        }
    } catch (const FormatError& error) {
        found.complaint = error.what();
    }
    return found;
}

// The required columns; `counts` as a data set that the caller makes.
void other_columns(Hdf5File& file, std::int64_t n) {
    std::vector<std::int64_t> half(static_cast<std::size_t>(n)), sign(half.size()), one(half.size(), 1);
    std::iota(half.begin(), half.end(), 0);
    for (std::size_t i = 0; i < sign.size(); ++i) sign[i] = i % 2 == 0 ? 1 : -1;
    file.group("/raw")
        .column("/raw/half", half)
        .column("/raw/bias_sign", sign)
        .column("/raw/mode", one)
        .column("/raw/loop_closed", one);
}

hid_t make_counts(const Hdf5File& file, hsize_t n, bool has_checksums) {
    const hsize_t chunk = 1000;
    const hsize_t limit = H5S_UNLIMITED;
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(creation, 1, &chunk);
    if (has_checksums) H5Pset_fletcher32(creation);
    const hid_t space = H5Screate_simple(1, &n, &limit);
    const hid_t set = H5Dcreate2(file.id(), "/raw/counts", H5T_STD_I64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Sclose(space);
    H5Pclose(creation);
    return set;
}

// Where the chunk lies in the file.
haddr_t address_of_counts(const Hdf5File& file, hsize_t chunk) {
    const hid_t set = H5Dopen2(file.id(), "/raw/counts", H5P_DEFAULT);
    const hid_t space = H5Dget_space(set);
    std::array<hsize_t, 1> offset{};
    unsigned filters = 0;
    haddr_t address = 0;
    hsize_t size = 0;
    H5Dget_chunk_info(set, space, chunk, offset.data(), &filters, &address, &size);
    EXPECT_EQ(offset[0], chunk * 1000);
    H5Sclose(space);
    H5Dclose(set);
    return address;
}

}  // namespace

TEST(InterruptedLog, a_part_that_was_cut_off_yields_true_rows_only) {
    const TemporaryFolder folder;
    constexpr std::int64_t n = 40'000;
    RawWriter writer{folder.file("raw.h5"), {}, false, all_raw_columns, keep_unfinished};
    write_rows(writer, n);
    writer.flush();
    const std::string whole = content_of(writer.part_path());
    EXPECT_EQ(read_all(writer.part_path()).rows, n);
    std::int64_t rows = n;
    int times_in_a_block = 0;
    for (std::size_t cut = 1; cut < whole.size(); cut += cut < 2'000'000 ? 61'001 : 1'000'000) {
        const Found found = read_all(folder.write("cut.part", whole.substr(0, whole.size() - cut)));
        EXPECT_FALSE(found.complete);
        EXPECT_LE(found.rows, rows) << cut;
        rows = found.rows;
        if (rows == n) continue;
        expect_contains(found.complaint, "cut.part, /raw/");
        if (rows == 0) continue;
        expect_contains(found.complaint, ", row " + std::to_string(rows + 1) + ": cannot be read: lies behind the end");
        times_in_a_block += rows % 16'384 != 0 ? 1 : 0;
    }
    EXPECT_EQ(rows, 0);
    EXPECT_GE(times_in_a_block, 3) << "a row that is whole is read, whatever is missing of its chunk";
}

TEST(InterruptedLog, a_chunk_that_was_never_written_is_not_read_as_zeros) {
    const TemporaryFolder folder;
    const std::string path = folder.file("raw.h5");
    const pid_t child = ::fork();
    if (child == 0) {
        {
            Hdf5File file{path};
            other_columns(file, 2500);
            const hid_t set = make_counts(file, 0, false);
            H5Dclose(set);
        }
        const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
        H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
        const hid_t copied = H5Fcreate((path + ".part").c_str(), H5F_ACC_EXCL, H5P_DEFAULT, access);
        const hid_t source = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
        H5Gclose(H5Gcreate2(copied, "/raw", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
        for (const char* name : {"/raw/half", "/raw/bias_sign", "/raw/mode", "/raw/loop_closed", "/raw/counts"}) {
            H5Ocopy(source, name, copied, name, H5P_DEFAULT, H5P_DEFAULT);
        }
        const hid_t set = H5Dopen2(copied, "/raw/counts", H5P_DEFAULT);
        const hsize_t written = 1000;
        const hsize_t length = 2500;
        const std::vector<std::int64_t> counts(1000, 7);
        H5Dset_extent(set, &written);
        H5Dwrite(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, counts.data());
        H5Dset_extent(set, &length);
        H5Dclose(set);
        const bool good = H5Fstart_swmr_write(copied) >= 0 && H5Fflush(copied, H5F_SCOPE_GLOBAL) >= 0;
        ::_exit(good ? 0 : 1);
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    ASSERT_EQ(status, 0);
    RawReader reader{path + ".part"};
    EXPECT_FALSE(reader.header().complete);
    HalfRecord row;
    for (int half = 0; half < 1000; ++half) {
        ASSERT_TRUE(reader.next(row));
        ASSERT_EQ(row.counts, 7);
    }
    expect_contains(message_of<FormatError>([&] { reader.next(row); }), "/raw/counts, row 1001: ");
}

TEST(InterruptedLog, the_rows_before_a_damaged_chunk_are_read) {
    const TemporaryFolder folder;
    const std::string path = folder.file("raw.h5");
    haddr_t address = 0;
    {
        Hdf5File file{path};
        other_columns(file, 20'000);
        const std::vector<std::int64_t> counts(20'000, 7);
        const hid_t set = make_counts(file, counts.size(), true);
        H5Dwrite(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, counts.data());
        H5Dclose(set);
        address = address_of_counts(file, 3);
    }
    std::string bytes = content_of(path);
    bytes[address + 100] = static_cast<char>(~bytes[address + 100]);
    RawReader reader{folder.write("damaged.h5", bytes)};
    HalfRecord row;
    for (int half = 0; half < 3000; ++half) {
        ASSERT_TRUE(reader.next(row)) << half;
        ASSERT_EQ(row.half, half);
        ASSERT_EQ(row.counts, 7);
    }
    for (int again = 0; again < 2; ++again) {
        expect_contains(message_of<FormatError>([&] { reader.next(row); }), "/raw/counts, row 3001: cannot be read");
    }
}

TEST(InterruptedLog, a_recording_that_was_given_up_is_not_complete_and_has_all_rows) {
    const TemporaryFolder folder;
    EXPECT_NE(zlg::test::refusal_by<FormatError>([&] {
                  RawWriter writer{folder.file("raw.h5"), {}, false, all_raw_columns, keep_unfinished};
                  write_rows(writer, 20'000);
                  HalfRecord bad = row_without_zero(20'000);
                  bad.piezo_v = std::numeric_limits<double>::quiet_NaN();
                  writer.write(bad, {light_without_zero(20'000)});
              }),
              "");
    const Found found = read_all(folder.file("raw.h5.part"));
    EXPECT_EQ(found.rows, 20'000);
    EXPECT_FALSE(found.complete);
    EXPECT_EQ(found.complaint, "");
    {
        AngleWriter writer{folder.file("a.h5"), 0.005, {}, false, {.keep_part = true}};
        for (int tick = 0; tick < 100; ++tick) writer.write({.tick = tick, .dtheta_arcsec = 7.0});
    }
    AngleReader angles{folder.file("a.h5.part")};
    EXPECT_FALSE(angles.header().complete);
    int rows = 0;
    for (TimedAngle angle; angles.next(angle); ++rows) ASSERT_EQ(angle.row.dtheta_arcsec, 7.0);
    EXPECT_EQ(rows, 100);
}

TEST(InterruptedLog, a_recording_without_a_row_leaves_nothing) {
    const TemporaryFolder folder;
    { RawWriter(folder.file("raw.h5"), {}, false, all_raw_columns, keep_unfinished); }
    { AngleWriter(folder.file("a.h5"), 0.005, {}, false, {.keep_part = true}); }
    EXPECT_TRUE(fs::is_empty(folder.file("")));
    {
        RawWriter writer{folder.file("raw.h5"), {}, false, all_raw_columns, keep_unfinished};
        write_rows(writer, 1);
    }
    EXPECT_EQ(read_all(folder.file("raw.h5.part")).rows, 1);
}
