#include <zlg/logs/error.hpp>
#include <zlg/logs/foreign_table.hpp>
#include <zlg/logs/matlab_copy.hpp>

#include "temporary_folder.hpp"

namespace zlg::logs::matlab_copy_test {

// As it is read again.
std::vector<double> column(const std::string& path, const std::string& name) {
    const ForeignTable table = foreign_table(path, {});
    for (const auto& each : table.columns)
        if (each.name == name) return each.values;
    return {};
}

core::HalfRecord half(int h) {
    core::HalfRecord record;
    record.half = h;
    record.bias_sign = static_cast<std::int8_t>(h % 2 == 0 ? 1 : -1);
    record.counts = -RawTable::max_counts + h;
    record.loop_closed = h != 1;
    record.piezo_v = 0.1 * h;
    return record;
}

TEST(MatlabCopy, HoldsTheColumnsThatARawLogHas) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("raw.mat");
    RawHeader header;
    header.has_piezo = true;
    MatlabCopy<RawTable> copy{path, header, false};
    for (int h = 0; h < 3; ++h) copy.write(half(h));
    EXPECT_FALSE(std::filesystem::exists(path));
    copy.close();
    EXPECT_EQ(column(path, "half"), (std::vector{0.0, 1.0, 2.0}));
    EXPECT_EQ(column(path, "bias_sign"), (std::vector{1.0, -1.0, 1.0}));
    EXPECT_EQ(column(path, "loop_closed"), (std::vector{1.0, 0.0, 1.0}));
    EXPECT_EQ(column(path, "counts"),
              (std::vector{-4503599627370496.0, -4503599627370495.0, -4503599627370494.0}));  // 2^52
    EXPECT_EQ(column(path, "piezo_v"), (std::vector{0.0, 0.1, 0.1 * 2}));
    EXPECT_TRUE(column(path, "temperature_c").empty());
}

TEST(MatlabCopy, HoldsTheFlagsOfAngles) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("angles.mat");
    MatlabCopy<AngleTable> copy{path, {.has_truth = true}, false};
    for (int k = 0; k < 2; ++k)
        copy.write({.row = {.tick = k, .dtheta_arcsec = 0.25, .flags = 0xFFFFFFFFu - static_cast<std::uint32_t>(k)},
                    .t_s = 0.005 * (k + 1),
                    .truth_dtheta_arcsec = 1e-30});
    copy.close();
    EXPECT_EQ(column(path, "flags"), (std::vector{4294967295.0, 4294967294.0}));
    EXPECT_EQ(column(path, "truth_dtheta_arcsec"), (std::vector{1e-30, 1e-30}));
}

TEST(MatlabCopy, IsNotThereUntilItIsClosed) {
    const test::TemporaryFolder folder;
    const std::string path = folder.file("raw.mat");
    {
        MatlabCopy<RawTable> copy{path, {}, false};
        copy.write({});
        EXPECT_TRUE(std::filesystem::exists(copy.part_path()));
    }
    EXPECT_TRUE(std::filesystem::is_empty(std::filesystem::path{path}.parent_path()));
    (void)folder.write("raw.mat", "mine");
    EXPECT_THROW((MatlabCopy<RawTable>{path, {}, false}), IoError);
}

}  // namespace zlg::logs::matlab_copy_test
