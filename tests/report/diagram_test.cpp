#include <zlg/report/diagram.hpp>

#include "test.hpp"

using zlg::report::Diagram;
using zlg::report::diagram_of;

namespace {

const std::string file =
    "<?xml version=\"1.0\"?>\n<svg class=\"figure\" id=\"loop\">\n<title id=\"t\">The loop</title>\n<desc "
    "id=\"d\">What goes where.</desc>\n<rect/>\n</svg>\n";

TEST(Diagram, brings_its_name_and_its_words_with_it) {
    const Diagram d = diagram_of(file);
    EXPECT_EQ(d.id, "loop");
    EXPECT_EQ(d.title, "The loop");
    EXPECT_EQ(d.caption, "What goes where.");
    EXPECT_EQ(d.file, file);
}

TEST(Diagram, stands_in_a_page_without_the_head_of_its_file) {
    EXPECT_EQ(svg(diagram_of(file)), file.substr(file.find("<svg")));
}

TEST(Diagram, without_its_words_is_refused) {
    EXPECT_THROW((void)diagram_of(""), std::out_of_range);
    EXPECT_THROW((void)diagram_of("<svg id=\"loop\"><title>The loop</title></svg>"), std::out_of_range);
}

}  // namespace
