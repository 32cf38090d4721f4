#include <zlg/logs/content_hash.hpp>
#include <zlg/logs/error.hpp>

#include "test.hpp"

namespace zlg::content_hash_test {

// Published vectors of XXH64 with the seed 0.
TEST(ContentHash, gives_the_published_values) {
    EXPECT_EQ(logs::content_hash(""), 0xef46db3751d8e999u);
    EXPECT_EQ(logs::content_hash("a"), 0xd24ec4f1a98c6e5bu);
    EXPECT_EQ(logs::content_hash("abc"), 0x44bc2cf5ad770999u);
}

TEST(ContentHash, pieces_make_the_whole) {
    logs::ContentHash hash;
    hash.add("a");
    hash.add("bc");
    EXPECT_EQ(hash.value(), logs::content_hash("abc"));
}

TEST(ContentHash, a_file_is_its_bytes_and_a_folder_is_none) {
    const std::string path = testing::TempDir() + "content_hash_test.txt";
    std::ofstream{path} << "abc";
    EXPECT_EQ(logs::hash_of_file(path), 0x44bc2cf5ad770999u);
    std::filesystem::remove(path);
    EXPECT_NE(test::message_of<logs::IoError>([&] { (void)logs::hash_of_file(path); }), "");
    EXPECT_NE(test::message_of<logs::IoError>([] { (void)logs::hash_of_file(testing::TempDir()); }), "");
}

}  // namespace zlg::content_hash_test
