// Claims about files of columns: what is written reads back, and a file is as before or whole.

#include <zlg/logs/column_file.hpp>
#include <zlg/logs/error.hpp>

#include "temporary_folder.hpp"

namespace zlg::logs::column_file_test {

class ColumnFiles : public testing::Test {
protected:
    [[nodiscard]] std::string path() const { return folder_.file("c.h5"); }

    zlg::test::TemporaryFolder folder_;
};

ColumnFile three() {
    return {.group = "/things",
            .columns = {{"n", "1", std::vector<std::int64_t>{1, -2}},
                        {"x_s", "s", std::vector<double>{0.5, std::numeric_limits<double>::infinity()}},
                        {"word", "", std::vector<std::string>{"", "a longer one"}}},
            .texts = {{"/note", "two\nlines"}},
            .marks = {{"format_version", 7}}};
}

TEST_F(ColumnFiles, read_back_what_is_written) {
    write_columns(path(), three());
    const ColumnReader file{path(), "/things"};
    EXPECT_EQ(file.integers("n"), (std::vector<std::int64_t>{1, -2}));
    EXPECT_EQ(file.reals("x_s"), (std::vector<double>{0.5, std::numeric_limits<double>::infinity()}));
    EXPECT_EQ(file.texts("word"), (std::vector<std::string>{"", "a longer one"}));
    EXPECT_EQ(file.text("/note"), "two\nlines");
    EXPECT_EQ(file.mark("format_version"), 7);
}

TEST_F(ColumnFiles, may_have_no_rows) {
    ColumnFile empty = three();
    empty.columns = {{"n", "1", std::vector<std::int64_t>{}}, {"word", "", std::vector<std::string>{}}};
    write_columns(path(), empty);
    EXPECT_TRUE((ColumnReader{path(), "/things"}.integers("n").empty()));
    EXPECT_TRUE((ColumnReader{path(), "/things"}.texts("word").empty()));
}

TEST_F(ColumnFiles, refuse_a_mark_that_is_no_exact_number) {
    ColumnFile large = three();
    large.marks = {{"largest", std::int64_t{1} << 53}, {"beyond", std::numeric_limits<std::int64_t>::max()}};
    write_columns(path(), large);
    const ColumnReader file{path(), "/things"};
    EXPECT_EQ(file.mark("largest"), std::int64_t{1} << 53);
    EXPECT_THROW((void)file.mark("beyond"), FormatError);
}

TEST_F(ColumnFiles, refuse_a_column_of_another_type_or_none) {
    write_columns(path(), three());
    const ColumnReader file{path(), "/things"};
    EXPECT_THROW((void)file.integers("x_s"), FormatError);
    EXPECT_THROW((void)file.reals("word"), FormatError);
    EXPECT_THROW((void)file.texts("n"), FormatError);
    EXPECT_THROW((void)file.reals("y_s"), FormatError);
    EXPECT_THROW((void)file.mark("version"), FormatError);
}

TEST_F(ColumnFiles, stay_as_they_were_where_writing_fails) {
    write_columns(path(), three());
    std::filesystem::create_directory(path() + ".new");
    EXPECT_THROW(write_columns(path(), ColumnFile{.group = "/other"}), IoError);
    EXPECT_EQ((ColumnReader{path(), "/things"}.mark("format_version")), 7);
}

TEST_F(ColumnFiles, need_a_folder) { EXPECT_THROW(write_columns(folder_.file("none/c.h5"), three()), IoError); }

}  // namespace zlg::logs::column_file_test
