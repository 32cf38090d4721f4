#include <zlg/report/page.hpp>

#include "test.hpp"

namespace {

using namespace zlg::report;

TEST(PageText, NumbersStandRightAndTheirHeadersWrap) {
    const Table table{.caption = "Two loops.",
                      .header = {"loop", "phase margin, deg", "stable"},
                      .rows = {{"analog", "81.3", "yes"}, {"digital", "-7", "no"}}};
    EXPECT_EQ(text(table),
              "             phase\n"
              "           margin,\n"
              "loop           deg  stable\n"
              "analog        81.3  yes\n"
              "digital         -7  no\n"
              "\n"
              "Two loops.\n");
}

TEST(PageText, ALongCellOfWordsTakesLinesAndEndsBesideTheNumbers) {
    const Table table{.caption = "",
                      .header = {"names", "n", "m", "k"},
                      .rows = {{"one_mode, switching, relock_frequency, configured", "1", "2", "3"}}};
    EXPECT_EQ(text(table),
              "names                     n  m  k\n"
              "one_mode, switching,\n"
              "relock_frequency,\n"
              "configured                1  2  3\n"
              "\n");
}

TEST(PageText, AWordIsNotDividedHoweverLongItIs) {
    const std::string word(30, 'a');
    const Table table{.caption = "", .header = {"names", "n", "m", "k"}, .rows = {{word, "1", "2", "3"}}};
    EXPECT_EQ(text(table), "names" + std::string(25, ' ') + "  n  m  k\n" + word + "  1  2  3\n\n");
}

TEST(PageText, HasTheVerdictAndTheSectionsButWhatIsOfThePage) {
    const Page page{.title = "title",
                    .verdict = "All is well.",
                    .lead = "lead",
                    .sections = {{.heading = "First", .paragraphs = {"some words"}, .code = "to copy\n"},
                                 {.heading = "Made", .paragraphs = {"by nobody"}, .is_of_page = true}}};
    EXPECT_EQ(text(page), "All is well.\n\nFirst\n-----\nsome words\n\nto copy\n");
}

TEST(PageText, WrapsParagraphsAtBlanksAndTakesNoLineFromAText) {
    const std::string word(30, 'a');
    const Page page{.title = "", .verdict = word + " " + word + "\n" + word + " " + word, .lead = "", .sections = {}};
    EXPECT_EQ(text(page), word + " " + word + " " + word + "\n" + word + "\n");
}

}  // namespace
