// Claims about the text of a row: it comes back bit for bit, and not at all where one character of it is wrong.

#include <zlg/sweep/row_text.hpp>

#include "test.hpp"

namespace zlg::sweep::row_text_test {

const Row row{.gyro = 7,
              .status = Status::not_finite,
              .reason = "no | \"gyro\"",
              .fingerprint = "0123456789abcdef",
              .metrics = {0.1 + 0.2, -0.0, std::nan(""), std::numeric_limits<double>::denorm_min()}};

TEST(RowText, comes_back_bit_for_bit) {
    const auto again = row_of(text_of(row), 4);
    ASSERT_TRUE(again);
    EXPECT_TRUE(are_equal(*again, row));
    EXPECT_EQ(text_of(row).find('\n'), std::string::npos);
}

TEST(RowText, one_wrong_character_or_another_number_of_metrics_is_no_row) {
    const std::string text = text_of(row);
    for (std::size_t k = 0; k < text.size(); ++k) {
        std::string wrong = text;
        wrong[k] ^= 1;
        EXPECT_FALSE(row_of(wrong, 4)) << wrong;
        EXPECT_FALSE(row_of(text.substr(0, k), 4)) << k;
    }
    EXPECT_FALSE(row_of(text, 3));
    EXPECT_FALSE(row_of(text, 5));
}

// The check value of CRC-32C in the catalogue of R. Williams: of the nine digits.
TEST(RowText, checksum_is_crc_32c) { EXPECT_EQ(text_checksum("123456789"), "e3069283"); }

}  // namespace zlg::sweep::row_text_test
