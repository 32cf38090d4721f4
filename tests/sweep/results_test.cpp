// Claims about result files: bytes follow from rows, what is written reads back, and damage is found.

#include <zlg/logs/column_file.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/sweep/results.hpp>

#include "descriptions.hpp"
#include "temporary_folder.hpp"

namespace zlg::sweep::results_test {

Rows two_rows() {
    Rows rows;
    rows[4] = {.gyro = 4, .fingerprint = "0123456789abcdef", .metrics = {1.5}};
    rows[1] = {.gyro = 1, .status = Status::refused, .reason = "why not", .metrics = {std::nan("")}};
    return rows;
}

// Changes bits of one byte of a number that the file holds.
template <class Number>
void flip(const test::TemporaryFolder& folder, const Number& number, std::size_t byte, int bits) {
    std::string bytes = test::content_of(folder.file("r.h5"));
    const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(&number), sizeof number));
    ASSERT_NE(at, std::string::npos);
    bytes[at + byte] = static_cast<char>(bytes[at + byte] ^ bits);
    folder.write("r.h5", bytes);
}

std::string refusal_of_file(const std::string& path) {
    return test::refusal_by<logs::FormatError>([&] { (void)read_results(path); });
}

TEST(Results, what_is_written_reads_back) {
    const test::TemporaryFolder folder;
    const Gyros gyros{short_sweep()};
    write_results(folder.file("r.h5"), gyros, two_rows());
    const Results read = read_results(folder.file("r.h5"));
    EXPECT_EQ(read.description, to_toml(gyros.description()));
    ASSERT_EQ(read.rows.size(), 2u);
    for (const auto& [gyro, row] : two_rows()) EXPECT_TRUE(are_equal(row, read.rows.at(gyro)));
}

TEST(Results, columns_are_those_of_the_gyros) {
    const test::TemporaryFolder folder;
    const Gyros gyros{short_sweep()};
    write_results(folder.file("r.h5"), gyros, two_rows());
    const logs::ColumnReader file{folder.file("r.h5"), "/gyros"};
    EXPECT_EQ(file.integers("gyro"), (std::vector<std::int64_t>{1, 4}));
    EXPECT_EQ(file.integers("seed"), (std::vector<std::int64_t>{gyros.seed(1), gyros.seed(4)}));
    EXPECT_EQ(file.reals("gyro.bias_chi")[1], std::get<double>(gyros.values(4)[0]));
}

TEST(Results, nothing_but_the_rows_decides_the_bytes) {
    const test::TemporaryFolder folder;
    const Gyros gyros{short_sweep()};
    write_results(folder.file("a.h5"), gyros, two_rows());
    Rows same = two_rows();
    same.at(1).metrics[0] = -std::numeric_limits<double>::quiet_NaN();
    write_results(folder.file("b.h5"), gyros, same);
    EXPECT_EQ(test::content_of(folder.file("a.h5")), test::content_of(folder.file("b.h5")));
    same.at(4).metrics[0] = 1.25;
    write_results(folder.file("b.h5"), gyros, same);
    EXPECT_NE(test::content_of(folder.file("a.h5")), test::content_of(folder.file("b.h5")));
}

TEST(Results, damage_is_an_error_and_never_a_crash) {
    const test::TemporaryFolder folder;
    write_results(folder.file("r.h5"), Gyros{short_sweep()}, two_rows());
    const std::string whole = test::content_of(folder.file("r.h5"));
    for (std::size_t size = 0; size < whole.size(); size += whole.size() / 40) {
        folder.write("cut.h5", whole.substr(0, size));
        EXPECT_THROW((void)read_results(folder.file("cut.h5")), std::runtime_error) << size;
    }
    folder.write("text.h5", "gyro,seed\n");
    EXPECT_THROW((void)read_results(folder.file("text.h5")), logs::FormatError);
    EXPECT_THROW((void)read_results(folder.file("none.h5")), logs::IoError);
}

TEST(Results, a_seed_that_is_not_the_gyros_is_damage) {
    const test::TemporaryFolder folder;
    Rows rows = two_rows();
    write_results(folder.file("r.h5"), Gyros{short_sweep()}, rows);
    flip(folder, Gyros{short_sweep()}.seed(4), 0, 1);
    test::expect_contains(refusal_of_file(folder.file("r.h5")), "row 2: seed is ");
}

// Reads a file of two rows of which one bit of a number was flipped.
std::string complaint_about_flipped(double number) {
    const test::TemporaryFolder folder;
    write_results(folder.file("r.h5"), Gyros{short_sweep()}, two_rows());
    flip(folder, number, 6, 1);
    return refusal_of_file(folder.file("r.h5"));
}

TEST(Results, a_number_that_was_changed_is_damage) {
    EXPECT_NE(complaint_about_flipped(1.5).find("is damaged, its checksum is"), std::string::npos);
    const double drawn = std::get<double>(Gyros{short_sweep()}.values(4)[0]);
    EXPECT_NE(complaint_about_flipped(drawn).find("the column gyro.bias_chi is not what the description draws"),
              std::string::npos);
}

TEST(Results, a_text_of_any_length_and_a_zero_of_either_sign_are_told_apart) {
    const test::TemporaryFolder folder;
    const std::string array = "[600.0" + std::string(1500, ' ') + ", 900.0]";
    std::string many = "[600.0";
    for (int k = 0; k < 900; ++k) many += ", 900.0";
    const Gyros gyros{
        parse("[sweep]\ngyros = 5\n[[parameter]]\nkeys = [\"design.run_lengths_s\"]\ndraw = \"list\"\nvalues = [" +
                  array + ", " + many +
                  "]]\n[[parameter]]\nkeys = [\"drift.magnetic_arcsec_s\"]\ndraw = \"list\"\nvalues = [0, 1]\n" +
                  testing_metric,
              "s")};
    write_results(folder.file("r.h5"), gyros, two_rows());
    EXPECT_EQ(read_results(folder.file("r.h5")).rows.size(), 2u);
    const logs::ColumnReader file{folder.file("r.h5"), "/gyros"};
    EXPECT_GT(file.texts("design.run_lengths_s")[0].size(), 4096u);
    flip(folder, std::array{1.0, 0.0}, 15, 0x80);  // of gyros 1 and 4
    EXPECT_THROW((void)read_results(folder.file("r.h5")), logs::FormatError);
}

TEST(Results, two_files_may_not_contradict_each_other) {
    Rows rows = two_rows();
    add_rows(rows, two_rows(), "again");
    EXPECT_EQ(rows.size(), 2u);
    Rows other = two_rows();
    other.at(4).metrics[0] = 2.5;
    EXPECT_THROW(add_rows(rows, other, "other"), logs::FormatError);
}

}  // namespace zlg::sweep::results_test
