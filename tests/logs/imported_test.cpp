#include <zlg/logs/imported.hpp>

#include "temporary_folder.hpp"

namespace zlg::logs::imported_test {

ForeignLook look_of(const std::string& text, std::initializer_list<const char*> said) {
    static const test::TemporaryFolder folder;  // the table reads the file again
    const std::string path = folder.write("foreign.csv", text);
    Mapping mapping;
    for (const char* pair : said) apply_mapping_pair(mapping, pair);
    return look_at_foreign(path, mapping);
}

TEST(ImportedRaw, a_missing_row_becomes_a_half_without_counts) {
    const ForeignLook look = look_of(
        "t_ms,counts,bias_sign\n0,151,1\n2.5,-149,-1\n5,150,1\n10,151,1\n12.5,-150,-1\n15,151,1\n17.5,-151,-1\n",
        {"mode=always:1", "loop_closed=always:1", "scale_arcsec=2"});
    const ImportedRaw made = imported_raw(look);
    ASSERT_EQ(made.rows.size(), 8u);
    EXPECT_FALSE(made.rows[3].valid);
    EXPECT_EQ(made.rows[3].counts, 0);
    EXPECT_EQ(made.rows[3].bias_sign, -1);
    EXPECT_EQ(made.rows[4].counts, 151);
    EXPECT_EQ(made.header.settings[0].second, "0.005");
}

TEST(ImportedRaw, rows_of_a_part_of_a_half_are_refused) {
    std::string text = "t_ms;counts;bias_sign\n";
    for (int k = 0; k < 24; ++k)
        text +=
            std::to_string(k) + ";" + std::to_string(k % 2 == 0 ? k : -k) + ";" + (k / 3 % 2 == 0 ? "1" : "-1") + "\n";
    const std::string said = test::message_of<FormatError>([&] {
        (void)imported_raw(look_of(text, {"mode=always:1", "loop_closed=always:1", "scale_arcsec=2"}));
    });
    for (const char* part : {"row 2: bias_sign", "7 times in 24 rows", "allowed is a row a half"})
        test::expect_contains(said, part);
}

TEST(ImportedAxes, a_hole_in_angles_keeps_the_turn) {
    const ImportedAxes made =
        imported_axes(look_of("time_s;angle\n0,0;1,5\n0,1;2,5\n0,2;4,5\n0,5;10,5\n0,6;11\n0,7;12\n0,8;11\n",
                              {"axis=angle", "holds=angle", "unit=arcsec"}));
    std::vector<core::AngleRow> rows;
    ASSERT_EQ(angle_rows(made.axes.front(), [&](const core::AngleRow& row) { rows.push_back(row); }), 8);
    ASSERT_EQ(rows.size(), 8u);
    for (int k = 2; k < 5; ++k) EXPECT_DOUBLE_EQ(rows[static_cast<std::size_t>(k)].dtheta_arcsec, 2.0);
    EXPECT_EQ(rows[3].flags, core::flag_invalid | core::flag_interpolated);
    EXPECT_EQ(rows[5].flags, 0u);
    EXPECT_TRUE(std::isinf(rows[0].sigma_arcsec));
}

TEST(ImportedAxes, what_is_missing_is_said_together) {
    const ForeignLook look = look_of("time;w\n0,1;1,5\n0,2;2,5\n0,3;2,25\n0,4;1,25\n", {});
    const std::string said = test::message_of<MappingError>([&] { (void)imported_axes(look); });
    for (const char* key : {"unit=", "holds=", "time_unit=s (then 10 Hz)"}) test::expect_contains(said, key);
}

}  // namespace zlg::logs::imported_test
