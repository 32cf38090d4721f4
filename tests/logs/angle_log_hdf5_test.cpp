#include <rapidcheck/gtest.h>

#include <zlg/logs/angle_log.hpp>
#include <zlg/logs/error.hpp>

#include "any_rows.hpp"
#include "hdf5_file.hpp"
#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;
using Settings = std::vector<std::pair<std::string, std::string>>;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<TimedAngle> any_angles() {
    std::vector<TimedAngle> angles(*rc::gen::inRange<std::size_t>(1, 40));
    for (std::size_t i = 0; i < angles.size(); ++i) {
        TimedAngle& a = angles[i];
        a.row.tick = static_cast<std::int64_t>(i);
        a.t_s = *any_finite_double();
        a.row.dtheta_arcsec = *any_finite_double();
        a.row.dtheta_final_arcsec = *any_finite_double();
        a.row.sigma_arcsec = *rc::gen::arbitrary<bool>() ? infinity : std::abs(*any_finite_double());
        a.row.mode = *rc::gen::element<std::int8_t>(-1, 1);
        a.row.flags = *rc::gen::arbitrary<std::uint32_t>();
        a.truth_dtheta_arcsec = *any_finite_double();
    }
    return angles;
}

void copy(const std::string& from, const std::string& to) {
    AngleReader reader{from};
    AngleWriter writer{to, 0.25, reader.header().settings, false, {.has_truth = reader.header().has_truth}};
    for (TimedAngle angle; reader.next(angle);) writer.write_timed(angle);
    writer.close();
}

std::string text_attribute(const std::string& path, const char* object, const char* name) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t attribute = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    char* text = nullptr;
    H5Aread(attribute, type, &text);
    std::string result = text == nullptr ? "" : text;
    H5free_memory(text);
    H5Tclose(type);
    H5Aclose(attribute);
    H5Fclose(file);
    return result;
}

// Our own /config, a text of fixed length.
std::string config_of(const std::string& path) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t set = H5Dopen2(file, "/config", H5P_DEFAULT);
    const hid_t type = H5Dget_type(set);
    std::string text(H5Tget_size(type), '?');
    H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data());
    H5Tclose(type);
    H5Dclose(set);
    H5Fclose(file);
    return text;
}

// What the reader says of three good rows that `change` has altered.
template <class Change> std::string complaint_about_angles(Change change) {
    const TemporaryFolder folder;
    const std::string path = folder.file("angles.h5");
    {
        Hdf5File file{path};
        file.group("/angles")
            .column<int>("/angles/tick", {0, 1, 2})
            .column<double>("/angles/t_s", {0.005, 0.01, 0.015})
            .column<double>("/angles/dtheta_arcsec", {1, 2, 3})
            .column<double>("/angles/dtheta_final_arcsec", {1, 2, 3})
            .column<double>("/angles/sigma_arcsec", {1, HUGE_VAL, 0})
            .column<int>("/angles/mode", {1, 1, -1})
            .column<int>("/angles/flags", {0, 1, 2});
        change(file);
    }
    return message_of<FormatError>([&] {
        AngleReader reader{path};
        for (TimedAngle angle; reader.next(angle);) continue;
    });
}

template <class T> std::string complaint_of(const std::string& column, const std::vector<T>& values) {
    return complaint_about_angles(
        [&](Hdf5File& file) { file.remove("/angles/" + column).column("/angles/" + column, values); });
}

}  // namespace

RC_GTEST_PROP(AngleLogHdf5, csv_to_hdf5_to_csv_is_the_same_file, ()) {
    const TemporaryFolder folder;
    const std::string first = folder.file("first.csv");
    Settings settings{{"gyro.tick_s", "5e-3"}, {"compensation.bridge", "quadratic"}, {"note", "a = b"}};
    if (*rc::gen::arbitrary<bool>()) settings.emplace_back("flags", "of:1 another:2 version:4");
    AngleWriter writer{first, 0.005, settings, false};
    for (const TimedAngle& angle : any_angles()) writer.write_timed(angle);
    writer.close();
    AngleReader reader{first};
    {
        AngleWriter to{folder.file("second.h5"), 0.005, reader.header().settings, false};
        for (TimedAngle angle; reader.next(angle);) to.write_timed(angle);
        to.close();
    }
    copy(folder.file("second.h5"), folder.file("third.csv"));
    RC_ASSERT(content_of(folder.file("third.csv")) == content_of(first));
}

RC_GTEST_PROP(AngleLogHdf5, hdf5_reads_back_the_same_bits_and_the_truth, ()) {
    const TemporaryFolder folder;
    const std::vector<TimedAngle> angles = any_angles();
    AngleWriter writer{folder.file("a.h5"), 0.25, {}, false, {.has_truth = true}};
    for (const TimedAngle& angle : angles) writer.write_timed(angle);
    writer.close();
    copy(folder.file("a.h5"), folder.file("b.hdf5"));
    AngleReader reader{folder.file("b.hdf5")};
    RC_ASSERT(reader.header().has_truth);
    TimedAngle angle;
    for (const TimedAngle& expected : angles) {
        RC_ASSERT(reader.next(angle));
        RC_ASSERT(angle.row == expected.row);
        RC_ASSERT(zlg::core::same_bits(angle.t_s, expected.t_s));
        RC_ASSERT(zlg::core::same_bits(angle.truth_dtheta_arcsec, expected.truth_dtheta_arcsec));
    }
    RC_ASSERT(!reader.next(angle));
}

TEST(AngleLogHdf5, times_end_the_ticks_and_blocks_join) {
    const TemporaryFolder folder;
    constexpr int n = 40'000;
    AngleWriter writer{folder.file("a.h5"), 0.25, {}, false};
    for (int tick = 0; tick < n; ++tick) {
        writer.write({.tick = tick, .dtheta_arcsec = 0.5 * tick, .flags = static_cast<std::uint32_t>(tick)});
    }
    writer.close();
    AngleReader reader{folder.file("a.h5")};
    TimedAngle angle;
    for (int tick = 0; tick < n; ++tick) {
        ASSERT_TRUE(reader.next(angle));
        ASSERT_EQ(angle.row.tick, tick);
        ASSERT_EQ(angle.row.dtheta_arcsec, 0.5 * tick);
        ASSERT_EQ(angle.row.flags, static_cast<std::uint32_t>(tick));
        ASSERT_EQ(angle.t_s, 0.25 * (tick + 1));
        ASSERT_TRUE(std::isnan(angle.truth_dtheta_arcsec));
    }
    EXPECT_FALSE(reader.next(angle));
    EXPECT_EQ(reader.fraction_read(), 1.0);
    EXPECT_FALSE(reader.header().has_truth);
}

TEST(AngleLogHdf5, has_units_the_legend_of_the_flags_and_the_tick) {
    const TemporaryFolder folder;
    const std::string path = folder.file("a.h5");
    AngleWriter writer{path, 0.0025, {{"gyro.scale_arcsec", "3.263"}}, false, {.has_truth = true}};
    writer.write({.tick = 0}, 1.0);
    writer.close();
    EXPECT_EQ(text_attribute(path, "/angles/tick", "unit"), "1");
    EXPECT_EQ(text_attribute(path, "/angles/t_s", "unit"), "s");
    EXPECT_EQ(text_attribute(path, "/angles/sigma_arcsec", "unit"), "arcsec");
    EXPECT_EQ(text_attribute(path, "/truth/dtheta_arcsec", "unit"), "arcsec");
    const std::string legend = text_attribute(path, "/angles/flags", "flags");
    EXPECT_EQ(legend,
              "switching:1 extrapolated:2 interpolated:4 correction:8 relock_corrected:16 relock_uncorrected:32 "
              "lower_order:64 unrepaired:128 loop_unlocked:256 invalid:512 mode_mixed:1024");
    EXPECT_EQ(AngleReader{path}.header().settings,
              (Settings{{"gyro.scale_arcsec", "3.263"}, {"flags", legend}, {"tick_s", "0.0025"}}));
}

TEST(AngleLogHdf5, copies_have_the_same_configuration) {
    for (const Settings& settings : {Settings{{"gyro.tick_s", "5e-3"}, {"note", "a b"}}, Settings{}}) {
        const TemporaryFolder folder;
        const std::string first = folder.file("a.h5");
        AngleWriter writer{first, 0.005, settings, false};
        writer.write({.tick = 0});
        writer.close();
        copy(first, folder.file("b.h5"));
        copy(first, folder.file("c.csv"));
        copy(folder.file("c.csv"), folder.file("d.h5"));
        const std::string config = config_of(first);
        EXPECT_EQ(config.find("flags"), std::string::npos) << config;
        EXPECT_EQ(config_of(folder.file("b.h5")), config);
        EXPECT_EQ(config_of(folder.file("d.h5")), config);
        EXPECT_EQ(AngleReader{folder.file("d.h5")}.header().settings, AngleReader{first}.header().settings);
        EXPECT_EQ(AngleReader{folder.file("d.h5")}.header().settings.back().second, "0.005");
    }
}

TEST(AngleLogHdf5, a_setting_tick_s_stands_for_the_writers_own_and_is_a_number) {
    const TemporaryFolder folder;
    const auto make = [&](const char* tick_s) { AngleWriter(folder.file("a.h5"), 0.25, {{"tick_s", tick_s}}, false); };
    expect_contains(message_of<FormatError>([&] { make("fast"); }),
                    "the setting tick_s is 'fast'; allowed is a number");
    AngleWriter writer{folder.file("a.h5"), 0.25, {{"tick_s", "0.005"}}, false};
    EXPECT_EQ(AngleReader{writer.part_path()}.header().settings.back().second, "0.005");
}

TEST(AngleLogHdf5, a_csv_log_has_no_truth) {
    const TemporaryFolder folder;
    AngleWriter writer{folder.file("a.csv"), 0.005, {}, false, {.has_truth = true}};
    writer.write({.tick = 0}, 1.0);
    writer.close();
    AngleReader reader{folder.file("a.csv")};
    TimedAngle angle;
    EXPECT_TRUE(reader.next(angle));
    EXPECT_FALSE(reader.header().has_truth);
    EXPECT_TRUE(reader.header().complete);
    EXPECT_FALSE(reader.refresh());
}

TEST(AngleWriter, refuses_angles_that_are_not_finite_and_sigmas_below_zero) {
    const TemporaryFolder folder;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    AngleWriter writer{folder.file("a.h5"), 0.005, {}, false, {.has_truth = true}};
    AngleWriter csv{folder.file("a.csv"), 0.005, {}, false};
    for (AngleWriter* each : {&writer, &csv}) {
        EXPECT_THROW(each->write({.dtheta_arcsec = nan}), FormatError);
        EXPECT_THROW(each->write({.dtheta_final_arcsec = infinity}), FormatError);
        EXPECT_THROW(each->write({.sigma_arcsec = nan}), FormatError);
        EXPECT_THROW(each->write({.sigma_arcsec = -1.0}), FormatError);
    }
    expect_contains(message_of<FormatError>([&] { writer.write({.tick = 3}, nan); }), "tick 3 cannot be logged: true");
    expect_contains(message_of<IoError>([&] { AngleWriter(folder.file("a.txt"), 0.005, {}, false); }),
                    "names no format");
    expect_contains(message_of<FormatError>([&] {
                        AngleWriter(folder.file("b.h5"), 0.005, {{"a.b", "1\n2"}}, false);
                    }),
                    "line break");
    EXPECT_FALSE(std::filesystem::exists(folder.file("b.h5.part")));
}

TEST(AngleReader, refuses_rows_of_an_hdf5_log_that_no_compensation_writes) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_contains(complaint_of<int>("tick", {0, 2, 3}),
                    "angles.h5, row 2, column '/angles/tick': '2' leaves a hole; expected 1");
    expect_contains(complaint_of<int>("tick", {-5, 1, 2}), "'-5' is out of range");
    expect_contains(complaint_of<double>("t_s", {0, nan, 0}), "'/angles/t_s': 'nan' is not finite");
    expect_contains(complaint_of<double>("dtheta_arcsec", {0, 0, infinity}), "row 3, column '/angles/dtheta_arcsec'");
    expect_contains(complaint_of<double>("dtheta_final_arcsec", {0, -infinity, 0}), "'-inf' is not finite");
    expect_contains(complaint_of<double>("sigma_arcsec", {0, -1, 0}), "'-1' is negative");
    expect_contains(complaint_of<double>("sigma_arcsec", {0, nan, 0}), "'nan' is not a number");
    expect_contains(complaint_of<int>("mode", {1, 1, 2}), "'2' is out of range; allowed is +1 or -1");
    expect_contains(complaint_of<int>("flags", {0, 1, -1}), "'-1' is out of range; allowed is 0..4294967295");
    expect_contains(complaint_of<double>("flags", {0, 1, 2}), "/angles/flags: holds another type");
    expect_contains(complaint_about_angles([](Hdf5File& f) { f.remove("/angles/t_s"); }),
                    "the column 't_s' is missing");
    expect_contains(complaint_about_angles([](Hdf5File& f) {
                        f.group("/truth").column<double>("/truth/dtheta_arcsec", {1, 2});
                    }),
                    "/truth/dtheta_arcsec has 2 rows, /angles/flags has 3");
}

TEST(AngleReader, refuses_texts_whose_heap_has_a_damaged_size) {
    const TemporaryFolder folder;
    const std::string path = folder.file("angles.h5");
    AngleWriter writer{path, 0.005, {{"gyro.scale_arcsec", "3.263"}}, true, {}};
    writer.write({.tick = 0, .sigma_arcsec = 1.0});
    writer.close();
    std::string file = content_of(path);
    const std::size_t collection = file.find("GCOL");
    ASSERT_NE(collection, std::string::npos);
    constexpr std::size_t size_of_first_object = 16 + 8;
    // The first makes a step of no bytes of the walk through the heap, which then never ends.
    for (const std::uint64_t size : {~std::uint64_t{15}, std::uint64_t{1} << 40, std::uint64_t{5000}}) {
        std::memcpy(&file[collection + size_of_first_object], &size, sizeof size);
        std::ofstream{path, std::ios::binary} << file;
        expect_contains(message_of<FormatError>([&] { AngleReader{path}; }),
                        "the attribute flags holds no text that can be read");
    }
}
