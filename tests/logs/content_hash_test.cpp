// Claims about content_hash: XXH64 with the seed 0, of bytes in any pieces.
#include <zlg/logs/content_hash.hpp>

#include "test.hpp"

namespace zlg::logs::content_hash_test {

TEST(ContentHash, is_that_of_its_authors) {
    // xxhsum -H64 of nothing and of "abc".
    EXPECT_EQ(content_hash(""), 0xef46db3751d8e999u);
    EXPECT_EQ(content_hash("abc"), 0x44bc2cf5ad770999u);
    ContentHash parted;
    parted.add("a");
    parted.add("bc");
    EXPECT_EQ(parted.value(), content_hash("abc"));
}

}  // namespace zlg::logs::content_hash_test
