#include <zlg/acceptance/report.hpp>
#include <zlg/logs/error.hpp>

#include "records.hpp"

namespace zlg::report_test {

using namespace acceptance_test;

std::string page() {
    write("rest.csv", {white(2000, 1.0)});
    const auto test = accepted(run("static", "rest.csv"), "'bias.deg_h' = { max = 1 }\n");
    return acceptance::report_html(acceptance::acceptance_page(test, "zlg accept plan.toml"));
}

void put(const std::string& name, const std::string& text) { std::ofstream{folder() + name} << text; }

TEST(Report, holds_its_record_and_a_seal_that_every_byte_breaks) {
    const std::string whole = page();
    put("report.html", whole);
    const std::string record = acceptance::read_report(folder() + "report.html");
    test::expect_contains(record, "\"passed\": true");
    EXPECT_EQ(whole, page()) << "the same inputs give the same bytes";
    for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 300) {
        std::string damaged = whole;
        damaged[at] = static_cast<char>(damaged[at] ^ 1);
        put("report.html", damaged);
        EXPECT_NE(test::message_of<logs::FormatError>([] { (void)acceptance::read_report(folder() + "report.html"); }),
                  "")
            << at;
    }
}

TEST(Report, a_log_is_known_by_its_bytes) {
    put("report.html", page());
    EXPECT_TRUE(acceptance::verify(folder() + "report.html", {folder() + "rest.csv", folder() + "plan.toml"}).fits);
    // A log may be named twice; what is left is said.
    const auto twice = acceptance::verify(folder() + "report.html", {folder() + "rest.csv", folder() + "rest.csv"});
    EXPECT_TRUE(twice.fits);
    test::expect_contains(twice.lines.at(3), "plan.toml: was not looked at");
    write("rest.csv", {white(2000, 1.0, 2)});
    EXPECT_FALSE(acceptance::verify(folder() + "report.html", {folder() + "rest.csv"}).fits);
}

// Whole, but of a program that writes another form.
TEST(Report, a_record_of_another_form_is_named) {
    for (const char* record :
         {"{}", "[1]", "{", R"({"passed": true, "unit": {"serial": 5, "type": "", "date": ""}})"}) {
        put("other.html", acceptance::report_html({.title = "t", .verdict = "v", .lead = "l", .data = record}));
        test::expect_contains(
            test::message_of<logs::FormatError>([] { (void)acceptance::read_report(folder() + "other.html"); }),
            "other.html: its record is not one as zlg");
    }
}

// Folders and pages of others are passed over.
TEST(Report, of_a_folder_those_that_are_reports) {
    const std::string reports = folder() + "reports/";
    std::filesystem::create_directories(reports + "more.html");
    put("reports/a.html", page());
    put("reports/b.html", "<html></html>");
    EXPECT_EQ(acceptance::read_reports(reports).size(), 1u);
    std::filesystem::remove_all(reports);
}

TEST(Report, a_text_of_the_plan_cannot_end_the_record) {
    write("rest.csv", {white(2000, 1.0)});
    const std::string runs = run("static", "rest.csv");
    std::ofstream{folder() + "plan.toml"} << "[unit]\nserial = '</script><b>'\n" << runs;
    const auto test = acceptance::accept({.plan = folder() + "plan.toml", .said = {}});
    put("report.html", acceptance::report_html(acceptance::acceptance_page(test, "")));
    test::expect_contains(acceptance::read_report(folder() + "report.html"), "\\u003c/script>");
}

}  // namespace zlg::report_test
