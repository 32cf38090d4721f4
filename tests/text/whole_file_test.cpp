#include <zlg/text/whole_file.hpp>

#include "test.hpp"

namespace zlg::text::whole_file_test {

TEST(WholeFile, IsReadUpToTheLimit) {
    const std::string path = std::filesystem::path{testing::TempDir()} / "zlg-whole-file";
    std::ofstream{path} << std::string(100'000, 'a');
    EXPECT_EQ(read_whole(path), std::string(100'000, 'a'));
    EXPECT_EQ(read_whole(path, 100'000).size(), 100'000u);
    EXPECT_THROW((void)read_whole(path, 99'999), TooLong);
    std::filesystem::remove(path);
}

TEST(WholeFile, WhatNeverEndsIsRefused) { EXPECT_THROW((void)read_whole("/dev/zero"), TooLong); }

TEST(WholeFile, SaysWhyItCannotBeRead) {
    EXPECT_EQ(test::message_of<CannotRead>([] { (void)read_whole(testing::TempDir()); }), "it is a folder");
    EXPECT_THROW((void)read_whole("/nowhere/at/all"), CannotRead);
}

}  // namespace zlg::text::whole_file_test
