#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include <zlg/logs/error.hpp>
#include <zlg/logs/text_columns.hpp>

#include "temporary_folder.hpp"

namespace {

using namespace zlg::logs;

class TextColumns : public ::testing::Test {
protected:
    std::string write(const std::string& text) {
        const std::string path = folder_.file("columns.txt");
        std::ofstream{path, std::ios::binary} << text;
        return path;
    }
    std::string complaint(const std::string& text, const TextLayout& layout) {
        try {
            (void)read_text_columns(write(text), layout);
        } catch (const FormatError& error) {
            return error.what();
        }
        return "";
    }

private:
    zlg::test::TemporaryFolder folder_;
};

TEST_F(TextColumns, blanks_and_separators_part_numbers) {
    const auto v = read_text_columns(write("  1 2\t3\n4, 5 ;6\r\n+7|8:-9e-1\n"), {.columns = {3, 1}});
    ASSERT_EQ(v.size(), 2u);
    EXPECT_EQ(v[0], (std::vector<double>{3.0, 6.0, -0.9}));
    EXPECT_EQ(v[1], (std::vector<double>{1.0, 4.0, 7.0}));
}

TEST_F(TextColumns, comments_empty_lines_and_lines_to_skip_are_left_out) {
    const auto v = read_text_columns(write("% head\n\n1 1 1\n% more\n2 2 2\n3\n4\n"),
                                     {.columns = {1}, .comment = "%", .skip_lines = 2});
    EXPECT_EQ(v[0], (std::vector<double>{3.0, 4.0}));
}

TEST_F(TextColumns, nan_and_an_empty_field_are_missing) {
    const auto v = read_text_columns(write("1,2\n,5\nNaN,6\n7,\n"), {.columns = {1, 2}});
    EXPECT_TRUE(std::isnan(v[0][1]));
    EXPECT_TRUE(std::isnan(v[0][2]));
    EXPECT_TRUE(std::isnan(v[1][3]));
    EXPECT_EQ(v[1][1], 5.0);
}

TEST_F(TextColumns, what_is_wrong_is_named_with_its_place) {
    EXPECT_NE(complaint("1 2\n3\n", {.columns = {2}}).find(":2, column 2: the line '3' ends before it"),
              std::string::npos);
    EXPECT_NE(complaint("1\nx7\n", {.columns = {1}}).find(":2, column 1: 'x7', allowed is a finite number"),
              std::string::npos);
    EXPECT_NE(complaint("inf\n", {.columns = {1}}).find("'inf'"), std::string::npos);
    EXPECT_NE(complaint("# nothing\n", {.columns = {1}}).find("no rows"), std::string::npos);
    EXPECT_NE(complaint("1\n", {.columns = {}}), "");
    EXPECT_THROW((void)read_text_columns("/no/such/file", {.columns = {1}}), IoError);
}

}  // namespace
