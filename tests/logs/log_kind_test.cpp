#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>
#include <zlg/logs/raw_log.hpp>

#include "hdf5_file.hpp"
#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;

namespace {

LogKind kind_of(std::string_view text, std::string_view name = "log.txt") {
    const TemporaryFolder folder;
    return recognise(folder.write(name, text));
}

void write_one_tick(const std::string& raw_path, const std::string& angle_path) {
    RawWriter raw{raw_path, {}, false};
    raw.write({.half = 0, .bias_sign = 1});
    raw.write({.half = 1, .bias_sign = -1});
    raw.close();
    AngleWriter angles{angle_path, 0.005, {}, false};
    angles.write({.tick = 0});
    angles.close();
}

}  // namespace

TEST(LogKind, is_told_from_the_column_names) {
    EXPECT_EQ(kind_of("# gyro.tick_s = 1\nhalf,bias_sign,mode,counts,loop_closed\n0,1,1,5,1\n"), LogKind::raw_csv);
    EXPECT_EQ(kind_of("tick,t_s,dtheta_arcsec,dtheta_final_arcsec,sigma_arcsec,mode,flags\n"), LogKind::angle_csv);
    EXPECT_EQ(kind_of("time,temperature_c,mode\n0,1,2\n"), LogKind::unknown);
}

TEST(LogKind, a_misspelt_column_does_not_hide_a_raw_log) {
    EXPECT_EQ(kind_of("haIf,bias_sign,mode,counts,loop_closed\n0,1,1,5,1\n"), LogKind::raw_csv);
}

TEST(LogKind, does_not_look_at_the_suffix) {
    const TemporaryFolder folder;
    EXPECT_EQ(kind_of("half,bias_sign,mode,counts,loop_closed\n", "raw.h5"), LogKind::raw_csv);
    write_one_tick(folder.file("raw.h5"), folder.file("angles.h5"));
    std::filesystem::rename(folder.file("raw.h5"), folder.file("raw.csv"));
    std::filesystem::rename(folder.file("angles.h5"), folder.file("angles"));
    EXPECT_EQ(recognise(folder.file("raw.csv")), LogKind::raw_hdf5);
    EXPECT_EQ(recognise(folder.file("angles")), LogKind::angle_hdf5);
}

TEST(LogKind, of_a_growing_log_is_known_before_its_first_row) {
    const TemporaryFolder folder;
    const RawWriter raw{folder.file("raw.h5"), {}, false};
    const AngleWriter angles{folder.file("angles.h5"), 0.005, {}, false};
    EXPECT_EQ(recognise(raw.part_path()), LogKind::raw_hdf5);
    EXPECT_EQ(recognise(angles.part_path()), LogKind::angle_hdf5);
}

TEST(LogKind, of_another_hdf5_file_is_unknown_and_of_a_damaged_one_an_error) {
    const TemporaryFolder folder;
    Hdf5File{folder.file("other.h5")}.group("/measurements");
    EXPECT_EQ(recognise(folder.file("other.h5")), LogKind::unknown);
    const std::string path = folder.write("damaged.h5", "\x89HDF\r\n\x1a\n\x02");
    expect_contains(message_of<FormatError>([&] { static_cast<void>(recognise(path)); }),
                    "damaged.h5: cannot be read as HDF5: ");
}

TEST(LogKind, of_anything_else_is_unknown) {
    EXPECT_EQ(kind_of(""), LogKind::unknown);
    EXPECT_EQ(kind_of("\x89HDF"), LogKind::unknown);
    EXPECT_EQ(kind_of(std::string_view{"half,counts\0,mode\n", 18}), LogKind::unknown);
    EXPECT_EQ(kind_of("0,1,1,5,1\n"), LogKind::unknown);
}

TEST(LogKind, refuses_what_is_no_file_to_read_twice) {
    const TemporaryFolder folder;
    expect_contains(message_of<IoError>([&] { static_cast<void>(recognise(folder.file("none"))); }), "No such file");
    expect_contains(message_of<IoError>([&] { static_cast<void>(recognise(folder.file(""))); }), "is a folder");
    expect_contains(message_of<IoError>([] { static_cast<void>(recognise("/dev/null")); }), "no regular file");
}

TEST(LogFormat, is_chosen_by_the_suffix) {
    EXPECT_EQ(format_of("/a.h5/b.csv"), LogFormat::csv);
    EXPECT_EQ(format_of("a.csv.h5"), LogFormat::hdf5);
    EXPECT_EQ(format_of("a.hdf5"), LogFormat::hdf5);
    for (const std::string path : {"a", "a.txt", "a.csv.gz", "a.H5", ".h5"}) {
        expect_contains(message_of<IoError>([&] { static_cast<void>(format_of(path)); }),
                        "names no format; allowed is .csv, .h5 or .hdf5");
    }
}
