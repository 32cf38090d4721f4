#include <gtest/gtest.h>

#include <zlg/logs/error.hpp>
#include <zlg/logs/log_kind.hpp>

#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;

namespace {

LogKind kind_of(std::string_view text, std::string_view name = "log.txt") {
    const TemporaryFolder folder;
    return recognise(folder.write(name, text));
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
    EXPECT_EQ(kind_of("half,bias_sign,mode,counts,loop_closed\n", "raw.h5"), LogKind::raw_csv);
    EXPECT_EQ(kind_of("\x89HDF\r\n\x1a\n\x02", "raw.csv"), LogKind::hdf5);
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
