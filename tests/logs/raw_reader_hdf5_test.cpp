// What the reader says of HDF5 logs that others have written, good and bad ones.

#include <zlg/logs/error.hpp>
#include <zlg/logs/raw_log.hpp>

#include "hdf5_file.hpp"
#include "raw_rows.hpp"
#include "temporary_folder.hpp"

using namespace zlg::logs;
using namespace zlg::test;
using zlg::core::HalfRecord;
using Settings = std::vector<std::pair<std::string, std::string>>;

namespace {

// What a laboratory would write with a few lines of its own: the required columns, three rows.
Hdf5File& three_rows(Hdf5File& file) {
    return file.group("/raw")
        .column<int>("/raw/half", {0, 1, 2})
        .column<int>("/raw/bias_sign", {1, -1, 1})
        .column<int>("/raw/mode", {1, 1, -1})
        .column<int>("/raw/counts", {150, -148, 151})
        .column<int>("/raw/loop_closed", {1, 1, 0});
}

// What the reader says of three good rows that `change` has altered.
template <class Change> std::string complaint_about_rows(Change change) {
    const TemporaryFolder folder;
    const std::string path = folder.file("raw.h5");
    {
        Hdf5File file{path};
        change(three_rows(file));
    }
    const std::string message = message_of<FormatError>([&] { static_cast<void>(rows_of(path)); });
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message.substr(std::min(message.find("raw.h5"), message.size()));
}

template <class Change> void refused(const char* why, Change change) {
    expect_contains(complaint_about_rows(change), why);
}

template <class T> std::string complaint_of(const std::string& column, const std::vector<T>& values) {
    return complaint_about_rows(
        [&](Hdf5File& file) { file.remove("/raw/" + column).column("/raw/" + column, values); });
}

// Another column of three rows, of which `prepare` says how it is stored.
template <class Prepare> void make_piezo(const Hdf5File& file, Prepare prepare, const hsize_t* limit = nullptr) {
    const hsize_t size = 3;
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t space = H5Screate_simple(1, &size, limit);
    prepare(creation, space);
    H5Dclose(H5Dcreate2(file.id(), "/raw/piezo_v", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, creation, H5P_DEFAULT));
    H5Sclose(space);
    H5Pclose(creation);
}

}  // namespace

TEST(RawReader, reads_an_hdf5_log_of_any_program_with_sections_in_its_configuration) {
    const TemporaryFolder folder;
    {
        Hdf5File file{folder.file("raw.dat")};
        three_rows(file)
            .column<double>("/raw/temperature_c", {20.0, 20.5, 21.0}, H5T_IEEE_F32BE)
            .column<int>("/raw/piezo_v", {100, 101, 102}, H5T_STD_I16LE, 2, 4)
            .text("/config",
                  "# instrument = 7\n[gyro]\nbias_hz = 60e3 # nominal\n[motion]\nkind = \"rest\"\n"
                  "phase_deg = [\n  1.0, # = no\n  2\n]\n")
            .attribute("tick_s", 0.0025)
            .attribute("format_version", 1);
    }
    RawReader reader{folder.file("raw.dat")};
    const RawHeader header = reader.header();
    EXPECT_EQ(header.settings, (Settings{{"instrument", "7"},
                                         {"gyro.bias_hz", "60e3"},
                                         {"motion.kind", "\"rest\""},
                                         {"motion.phase_deg", "[1.0, 2]"},
                                         {"gyro.tick_s", "0.0025"}}));
    EXPECT_TRUE(header.has_temperature && header.has_piezo);
    EXPECT_FALSE(header.has_valid || header.has_detuning || header.has_detuning_sq);
    const auto rows = rows_of(reader);
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[1].counts, -148);
    EXPECT_EQ(rows[1].piezo_v, 101.0);
    EXPECT_EQ(rows[1].temperature_c, 20.5);
    EXPECT_EQ(rows[2].mode, -1);
    EXPECT_FALSE(rows[2].loop_closed);
    EXPECT_TRUE(rows[2].valid);
    EXPECT_TRUE(std::isnan(rows[2].detuning_lambda));
}

TEST(RawReader, a_packed_column_of_large_chunks_is_read) {
    const TemporaryFolder folder;
    constexpr std::size_t n = 300'000;
    std::vector<std::int64_t> half(n), sign(n), one(n, 1), counts(n);
    for (std::size_t i = 0; i < n; ++i) {
        half[i] = static_cast<std::int64_t>(i);
        sign[i] = i % 2 == 0 ? -1 : 1;
        counts[i] = 7 * half[i];
    }
    Hdf5File{folder.file("raw.h5")}
        .group("/raw")
        .column("/raw/half", half, H5T_STD_I64LE, n, 1)
        .column("/raw/bias_sign", sign, H5T_STD_I8LE, n / 3)
        .column("/raw/mode", one, H5T_STD_I32BE)
        .column("/raw/counts", counts, H5T_STD_I64BE, 1000, 1)
        .column("/raw/loop_closed", one, H5T_STD_U8LE, n, 9);
    const auto rows = rows_of(folder.file("raw.h5"));
    ASSERT_EQ(rows.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
        ASSERT_EQ(rows[i].counts, 7 * static_cast<std::int64_t>(i));
        ASSERT_EQ(rows[i].bias_sign, i % 2 == 0 ? -1 : 1);
    }
}

TEST(RawReader, refuses_values_of_an_hdf5_log_that_no_gyro_can_have_recorded) {
    EXPECT_EQ(complaint_of<std::int64_t>("counts", {1, 2, 4503599627370497}),
              "raw.h5, row 3, column '/raw/counts': '4503599627370497' is out of range; allowed is "
              "-4503599627370496..4503599627370496");
    expect_contains(complaint_of<int>("half", {1, 2, 3}), "row 1, column '/raw/half': '1' leaves a hole; expected 0");
    expect_contains(complaint_of<int>("half", {0, 1, 1}), "row 3, column '/raw/half': '1' is a repetition; expected 2");
    expect_contains(complaint_of<int>("half", {0, -1, 2}), "'-1' is out of range; allowed is 0..");
    expect_contains(complaint_of<std::uint64_t>("half", {0, 1, 1ull << 63}), "'9223372036854775807' leaves a hole");
    expect_contains(complaint_of<int>("bias_sign", {1, 1, -1}),
                    "row 2, column '/raw/bias_sign': '1' as in the row before; expected -1: it must alternate");
    expect_contains(complaint_of<int>("bias_sign", {0, 1, -1}), "'0' is out of range; allowed is +1 or -1");
    expect_contains(complaint_of<int>("bias_sign", {257, -1, 1}), "'257' is out of range; allowed is +1 or -1");
    expect_contains(complaint_of<int>("mode", {1, 1, 1 << 20}), "'1048576' is out of range; allowed is +1 or -1");
    expect_contains(complaint_of<int>("loop_closed", {1, 2, 1}), "'2' is out of range; allowed is 0 or 1");
    expect_contains(complaint_of<int>("valid", {1, 1, -255}), "'-255' is out of range; allowed is 0 or 1");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_contains(complaint_of<double>("piezo_v", {1.0, nan, 1.0}),
                    "row 2, column '/raw/piezo_v': 'nan' is not finite");
    expect_contains(complaint_of<double>("temperature_c", {-HUGE_VAL, 1.0, 1.0}), "'-inf' is not finite");
    expect_contains(complaint_of<double>("detuning_lambda", {0.1, -31.0, 0.0}),
                    "row 2, column '/raw/detuning_lambda': '-31' is out of range; allowed is -30..30 wavelengths");
    expect_contains(complaint_of<double>("detuning_sq_lambda2", {0.01, 0.0, -0.01}),
                    "'-0.01' is out of range; allowed is 0..900 wavelengths^2");
    refused("row 3, column '/raw/light': 'inf' is out of range; allowed is a finite number, or nan",
            [](Hdf5File& file) {
                file.table<float>("/raw/light", {1, 2, 3, 4, std::numeric_limits<float>::infinity(), 6}, {3, 2});
            });
}

TEST(RawReader, hands_out_the_rows_of_an_hdf5_log_before_the_first_bad_one) {
    const TemporaryFolder folder;
    {
        Hdf5File file{folder.file("raw.h5")};
        three_rows(file).column<double>("/raw/piezo_v", {1.0, 2.0, HUGE_VAL}).column<int>("/raw/valid", {1, 1, 7});
    }
    RawReader reader{folder.file("raw.h5")};
    HalfRecord row;
    EXPECT_TRUE(reader.next(row));
    EXPECT_TRUE(reader.next(row));
    EXPECT_EQ(row.piezo_v, 2.0);
    for (int again = 0; again < 2; ++again) {
        expect_contains(message_of<FormatError>([&] { reader.next(row); }), "row 3, column '/raw/valid'");
    }
}

TEST(RawReader, refuses_data_sets_that_are_no_columns) {
    expect_contains(complaint_of<double>("counts", {1, 2, 3}), "/raw/counts: holds another type; allowed are integers");
    refused("/raw/piezo_v: holds another type", [](Hdf5File& f) { f.text("/raw/piezo_v", "x"); });
    refused("/raw/piezo_v: is no data set", [](Hdf5File& f) { f.group("/raw/piezo_v"); });
    refused("numbers of at most 8 bytes", [](Hdf5File& f) {
        f.column<double>("/raw/piezo_v", {1, 2, 3}, H5T_NATIVE_LDOUBLE);
    });
    refused("/raw/piezo_v: has 2 dimensions; allowed is 1", [](Hdf5File& f) {
        f.table<double>("/raw/piezo_v", {1, 2, 3}, {3, 1});
    });
    refused("allowed is 2", [](Hdf5File& f) { f.column<float>("/raw/light", {1, 2, 3}); });
    refused("has 65 values in a row; allowed is 1..64", [](Hdf5File& f) {
        f.table<float>("/raw/light", std::vector<float>(195), {3, 65});
    });
    refused("/raw/light_b has 2 samples in a half; allowed are the 0 of /raw/light", [](Hdf5File& f) {
        f.table<float>("/raw/light_b", {1, 2, 3, 4, 5, 6}, {3, 2});
    });
    expect_contains(complaint_of<int>("mode", {1, 1}),
                    "/raw/mode has 2 rows, /raw/loop_closed has 3; allowed is one length");
    refused("/raw: the column 'counts' is missing", [](Hdf5File& f) { f.remove("/raw/counts"); });
    refused("unknown column 'valld'; did you mean 'valid'?", [](Hdf5File& f) {
        f.column<int>("/raw/valld", {1, 1, 1});
    });
    refused("the group /raw is missing", [](Hdf5File& f) { f.remove("/raw"); });
    refused("/raw: is no group", [](Hdf5File& f) { f.remove("/raw").column<int>("/raw", {1}); });
}

TEST(RawReader, ignores_an_unknown_data_set_with_a_warning) {
    const TemporaryFolder folder;
    {
        Hdf5File file{folder.file("raw.h5")};
        three_rows(file).column<double>("/raw/operator", {1, 2});
    }
    const RawReader reader{folder.file("raw.h5")};
    ASSERT_EQ(reader.header().warnings.size(), 1u);
    expect_contains(reader.header().warnings[0], "raw.h5, /raw: the unknown column 'operator' is ignored");
}

TEST(RawReader, reads_nothing_that_lies_outside_the_file) {
    const TemporaryFolder folder;
    const std::string secret = folder.write("secret", std::string(24, 'x'));
    refused("/raw/piezo_v: is stored in another file", [&](Hdf5File& f) {
        make_piezo(f, [&](hid_t creation, hid_t) { H5Pset_external(creation, secret.c_str(), 0, 24); });
    });
    refused("/raw/piezo_v: a link that leads elsewhere", [&](Hdf5File& f) {
        H5Lcreate_external("other.h5", "/x", f.id(), "/raw/piezo_v", H5P_DEFAULT, H5P_DEFAULT);
    });
    refused("/raw/piezo_v: is stored in another file", [](Hdf5File& f) {
        make_piezo(f, [](hid_t creation, hid_t space) { H5Pset_virtual(creation, space, "other.h5", "/x", space); });
    });
}

TEST(RawReader, refuses_chunks_that_only_a_hostile_file_has) {
    refused("/raw/piezo_v: chunks of 9000000 x 1 values; allowed are 8388608", [](Hdf5File& f) {
        const hsize_t chunk = 9'000'000, limit = H5S_UNLIMITED;
        make_piezo(
            f, [&](hid_t creation, hid_t) { H5Pset_chunk(creation, 1, &chunk); }, &limit);
    });
}

TEST(RawReader, refuses_a_configuration_that_contradicts_or_is_none) {
    refused("the attribute tick_s is 0.01, but /config says 0.005",
            [](Hdf5File& f) { f.text("/config", "gyro.tick_s = 0.005\n").attribute("tick_s", 0.01); });
    refused("/config:2:", [](Hdf5File& f) { f.text("/config", "a = 1\nb =\n"); });
    refused("/config: allowed is one text", [](Hdf5File& f) { f.column<int>("/config", {1}); });
    refused("format_version is 4; allowed is 1 to 3", [](Hdf5File& f) { f.attribute("format_version", 4); });
    refused("the attribute tick_s is inf; allowed is a finite number",
            [](Hdf5File& f) { f.attribute("tick_s", HUGE_VAL); });
    refused("the attribute tick_s is the text '0.005'; allowed is a finite number",
            [](Hdf5File& f) { f.text_attribute("tick_s", "0.005"); });
    refused("the attribute format_version is the text '1'; allowed is a finite number",
            [](Hdf5File& f) { f.text_attribute("format_version", "1"); });
    refused("the attribute scale_arcsec is a list of 2 numbers; allowed is a finite number", [](Hdf5File& f) {
        f.attributes("scale_arcsec", {3.2, 3.3});
    });
}

TEST(RawReader, an_hdf5_log_without_rows_is_an_error_once_it_is_complete) {
    const TemporaryFolder folder;
    RawWriter writer{folder.file("raw.h5"), {}, false};
    HalfRecord row;
    EXPECT_FALSE(RawReader{writer.part_path()}.next(row));
    writer.close();
    expect_contains(message_of<FormatError>([&] { RawReader{folder.file("raw.h5")}; }), "is empty: no rows in /raw");
}

TEST(RawReader, a_file_that_another_program_left_open_is_named_as_such) {
    const TemporaryFolder folder;
    const std::string path = folder.file("raw.h5");
    {
        Hdf5File file{path};
        three_rows(file);
    }
    // The writer's mark in the superblock (version 2 and later: byte 11, bit 0), as a killed program leaves it.
    std::string bytes = content_of(path);
    bytes[8] = 3;
    bytes[11] = 1;
    expect_contains(message_of<FormatError>([&] { RawReader{folder.write("b.h5", bytes)}; }), "left unfinished");
}
