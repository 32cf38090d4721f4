// Claims about the page of a sweep: it says what came out, whatever did.

#include <zlg/sweep/sweep_page.hpp>

#include "descriptions.hpp"

namespace zlg::sweep::sweep_page_test {

Description limited(int gyros) {
    return parse("[sweep]\ngyros = " + std::to_string(gyros) +
                     "\n[[parameter]]\nkeys = [\"gyro.bias_chi\"]\ndraw = \"sobol\"\nmin = 3\nmax = 4\n" +
                     testing_metric + "max = 3.5\n",
                 "s");
}

// The metric is the parameter itself; the gyros from `failed` on have none.
Rows rows_of(const Gyros& gyros, std::int64_t failed) {
    Rows rows;
    for (std::int64_t k = 0; k < gyros.description().n_gyros; ++k) {
        const double value = std::get<double>(gyros.values(k)[0]);
        rows[k] = k < failed ? Row{.gyro = k, .fingerprint = "f", .metrics = {value}}
                             : Row{.gyro = k, .status = Status::lost, .reason = "gone", .metrics = {std::nan("")}};
    }
    return rows;
}

const report::Section* section(const report::Page& page, const std::string& heading) {
    for (const report::Section& s : page.sections)
        if (s.heading == heading) return &s;
    return nullptr;
}

TEST(SweepPage, leads_with_the_yield) {
    const Gyros gyros{limited(64)};
    const report::Page page = sweep_page(gyros, rows_of(gyros, 60));
    EXPECT_NE(page.verdict.find("of 64 gyros pass"), std::string::npos) << page.verdict;
    EXPECT_NE(page.verdict.find("4 failed"), std::string::npos);
    EXPECT_NE(section(page, "Gyros to look at")->code.find(gyros.command(60)), std::string::npos);
    EXPECT_EQ(parse(section(page, "How this page was made")->code, "page"), gyros.description());
    EXPECT_NE(report::html(page).find("<svg"), std::string::npos);
}

TEST(SweepPage, knows_a_dependence) {
    const Gyros gyros{limited(64)};
    const report::Page page = sweep_page(gyros, rows_of(gyros, 64));
    EXPECT_EQ(section(page, "What the numbers depend on")->tables[0].rows[0][1], "1.00");
}

TEST(SweepPage, is_made_also_where_all_failed_or_one_gyro_is_there) {
    for (const std::int64_t failed : {0, 1}) {
        const Gyros gyros{limited(1)};
        EXPECT_FALSE(report::html(sweep_page(gyros, rows_of(gyros, failed))).empty());
    }
    const Gyros plain{short_sweep(2)};
    Rows rows;
    rows[0] = {.gyro = 0, .metrics = {1.0}};
    EXPECT_NE(sweep_page(plain, rows).verdict.find("1 gyros, none failed"), std::string::npos);
}

}  // namespace zlg::sweep::sweep_page_test
