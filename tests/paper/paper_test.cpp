#include <zlg/paper/paper.hpp>
#include <zlg/report/export.hpp>

#include "paper_parts.hpp"
#include "test.hpp"

namespace zlg::paper_test {

paper::PaperTask small_task(int threads = 2) {
    paper::PaperTask task;
    task.config.run.duration_s = 60.0;
    task.config.switching.interval_s = 5.0;
    task.threads = threads;
    task.switches_per_point = 200;
    return task;
}

// One recomputation serves every test here.
const paper::Paper& paper() {
    static const paper::Paper made = paper::recompute_paper(small_task());
    return made;
}

const report::Figure& figure(std::string_view id) {
    for (const auto& item : paper().items)
        for (const auto& f : item.section.figures)
            if (f.id == id) return f;
    throw std::out_of_range{std::string{id}};
}

const report::Series& series(std::string_view id, std::string_view name) {
    for (const auto& s : figure(id).series)
        if (s.name == name) return s;
    throw std::out_of_range{std::string{id} + ": " + std::string{name}};
}

double value_at(const report::Series& s, double x) {
    for (std::size_t i = 0; i < s.x.size(); ++i)
        if (std::abs(s.x[i] - x) < 1e-9 * std::abs(x)) return s.y[i];
    throw std::out_of_range{s.name};
}

// Deviation in standard errors.
double deviation(const report::Series& s, double x, double expected) {
    for (std::size_t i = 0; i < s.x.size(); ++i)
        if (std::abs(s.x[i] - x) < 1e-9 * std::abs(x)) return (s.y[i] - expected) / s.y_error.at(i);
    throw std::out_of_range{s.name};
}

TEST(Paper, has_every_figure_and_table_in_the_order_of_the_print) {
    std::vector<std::string> numbers;
    for (const auto& item : paper().items) numbers.push_back(item.number);
    EXPECT_EQ(numbers, (std::vector<std::string>{"figure 1", "figure 2", "figure 3", "figure 4", "figure 5", "table 1",
                                                 "table 2", "figure 6", "figure 7", "figure 8a", "figure 8b",
                                                 "figure 9a", "figure 9b", "figure 9c", "figure 10a", "figure 10b",
                                                 "figure 10c", "figure 11"}));
}

TEST(Paper, every_item_shows_something_and_says_what_agrees) {
    for (const auto& item : paper().items) {
        EXPECT_FALSE(item.section.heading.empty()) << item.number;
        EXPECT_FALSE(item.section.paragraphs.empty()) << item.number;
        EXPECT_GT(item.section.figures.size() + item.section.diagrams.size() + item.section.tables.size(), 0u)
            << item.number;
    }
}

TEST(Paper, figures_can_be_files_and_have_labelled_axes_and_data) {
    std::set<std::string> ids;
    const auto take = [&](const std::string& id) {
        EXPECT_TRUE(ids.insert(id).second) << id << " comes twice";
        EXPECT_TRUE(std::all_of(id.begin(), id.end(), [](unsigned char c) { return std::isalnum(c) || c == '-'; }))
            << id;
    };
    for (const auto& item : paper().items) {
        for (const auto& d : item.section.diagrams) take(d.id);
        for (const auto& f : item.section.figures) {
            take(f.id);
            EXPECT_FALSE(f.x_label.empty() || f.y_label.empty() || f.title.empty()) << f.id;
            EXPECT_EQ(report::csv(f).find("no data"), std::string::npos);
            for (const auto& s : f.series)
                EXPECT_TRUE(s.name.empty() ||
                            std::any_of(s.y.begin(), s.y.end(), [](double y) { return std::isfinite(y); }))
                    << f.id << ": " << s.name;
        }
    }
}

TEST(Paper, the_twin_agrees_with_theory) {
    // 34 experiments with motion have two components, 8 of noise one, of five estimators each.
    EXPECT_EQ(paper().degrees_of_freedom, 5 * (2 * 34 + 8));
    EXPECT_GT(paper().chi2_per_dof, 0.7);
    EXPECT_LT(paper().chi2_per_dof, 1.4);
}

TEST(Paper, corrected_error_at_the_extremum_is_that_of_the_exact_weights) {
    // By hand from the weights of (15): 12000 "/s, 20 Hz, 5 ms; constant and quadratic.
    struct Known {
        const char* id;
        double constant, quadratic;
    };
    for (const Known& k :
         {Known{"figure-10a", 26.03, 1.44}, Known{"figure-10b", 77.57, 8.19}, Known{"figure-10c", 154.51, 26.85}}) {
        const auto& constant = series(k.id, "constant = linear");
        EXPECT_NEAR(constant.y.back() * 12000.0 / constant.x.back(), k.constant, 0.006) << k.id;
        const auto& quadratic = series(k.id, "quadratic");
        EXPECT_NEAR(quadratic.y.back() * 12000.0 / quadratic.x.back(), k.quadratic, 0.006) << k.id;
        EXPECT_LT(std::abs(deviation(series(k.id, "twin, constant = linear"), 12000.0, k.constant)), 4.5) << k.id;
        EXPECT_LT(std::abs(deviation(series(k.id, "twin, quadratic"), 12000.0, k.quadratic)), 4.5) << k.id;
    }
}

TEST(Paper, nothing_stays_in_the_angle_at_a_zero_crossing) {
    for (const char* id : {"figure-8a", "figure-9a", "figure-9b", "figure-9c"})
        for (const char* name : {"twin, constant = linear", "twin, quadratic"})
            for (const double x : series(id, name).x)
                EXPECT_LT(std::abs(deviation(series(id, name), x, 0.0)), 4.5) << id << ", " << name << " at " << x;
}

TEST(Paper, series_as_printed_is_short_of_a_quarter_of_its_cubic_term) {
    const auto& printed = series("figure-8a", "series as printed, cubic term 1");
    const auto& right = series("figure-8a", "series, cubic term 4/3");
    EXPECT_NEAR(printed.y.at(4) / right.y.at(4), 0.75, 0.001) << "at small times the cubic term is all there is";
    // A (pi nu x)^3 - (4/15) A (pi nu x)^5 over three ticks, x = 10 ms, 20 Hz.
    const double u = 0.2 * 3.14159265358979;
    EXPECT_NEAR(value_at(printed, 0.2), 12000.0 * (u * u * u - 4.0 / 15.0 * std::pow(u, 5)) * 0.015, 1e-6);
}

TEST(Paper, noise_has_the_gain_of_the_sum) {
    // A tick of a count of 3.263 arcsec is off by 3.263/sqrt 6. Constant from 2 + 2 ticks for three: white, 3/4 of each
    // of four ticks, 1.5; roundings at four edges with 3/4 each, sqrt(4 (3/4)^2/2) of the tick's own.
    const double three_sigma = 3.0 * 3.263 / std::sqrt(6.0);
    EXPECT_NEAR(value_at(series("figure-11", "constant = linear, white noise"), 3.0), 1.5 * three_sigma, 1e-9);
    EXPECT_NEAR(value_at(series("figure-11", "constant = linear, counter"), 3.0), std::sqrt(9.0 / 8.0) * three_sigma,
                1e-9);
    EXPECT_NEAR(value_at(series("figure-11", "constant as printed, A\u221An/2"), 3.0),
                three_sigma * std::sqrt(3.0) / 2.0, 1e-9);
    // Quadratic: -1, 5/2, 5/2, -1.
    EXPECT_NEAR(value_at(series("figure-11", "quadratic, white noise"), 3.0), std::sqrt(14.5) * three_sigma, 1e-9);
    // The twin's further noise is small.
    EXPECT_NEAR(value_at(series("figure-11", "constant = linear, twin"), 3.0), std::sqrt(9.0 / 8.0) * three_sigma, 0.8);
}

TEST(Paper, figure_6_shows_the_gap_and_takes_back_what_was_extrapolated) {
    const auto& item = paper().items.at(7);
    ASSERT_EQ(item.section.figures.at(0).bands.size(), 1u);
    EXPECT_EQ(item.section.figures[0].bands[0].x0, 0.5);
    EXPECT_EQ(item.section.figures[0].bands[0].x1, 3.5);
    for (const double x : series("figure-6", "as read").x)
        EXPECT_TRUE(x < 1.0 || x > 3.0) << "a blind reading is drawn";
    const auto& rows = item.section.tables.at(0).rows;
    ASSERT_EQ(rows.size(), 5u);
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i) sum += std::stod(rows[i][1]);
    EXPECT_NEAR(std::stod(rows[3][1]), sum, 0.02);
    EXPECT_NEAR(std::stod(rows[4][1]), std::stod(rows[3][1]) - std::stod(rows[3][2]), 0.02);
}

TEST(Paper, figure_6_of_a_run_without_a_switch_says_so) {
    const paper::PaperItem item = paper::paper_figure_6(study::RunResult{});
    EXPECT_TRUE(item.section.figures.empty());
    EXPECT_EQ(item.section.paragraphs.size(), 1u);
}

TEST(Paper, figure_1_counts_the_bias_of_both_signs) {
    const auto& beat = series("figure-1-beat", "mean over the half");
    for (std::size_t i = 0; i + 1 < beat.y.size(); ++i) EXPECT_NEAR(beat.y[i], i % 2 == 0 ? 60.0 : -60.0, 0.5);
}

TEST(Paper, same_on_one_thread_and_on_two) {
    paper::PaperTask one = small_task(1);
    paper::PaperTask two = small_task(2);
    one.switches_per_point = two.switches_per_point = 100;
    const auto a = paper::paper_figures_8_to_11(one);
    const auto b = paper::paper_figures_8_to_11(two);
    EXPECT_EQ(a.chi2_per_dof, b.chi2_per_dof);
    for (std::size_t i = 0; i < a.items.size(); ++i)
        for (std::size_t k = 0; k < a.items[i].section.figures.size(); ++k)
            EXPECT_EQ(report::csv(a.items[i].section.figures[k]), report::csv(b.items[i].section.figures[k]));
}

TEST(Paper, another_seed_gives_other_points_and_the_same_theory) {
    paper::PaperTask task = small_task();
    task.switches_per_point = 100;
    const auto a = paper::paper_figures_8_to_11(task);
    task.config.run.seed = 2;
    const auto b = paper::paper_figures_8_to_11(task);
    const auto& fa = a.items.back().section.figures.at(0).series;
    const auto& fb = b.items.back().section.figures.at(0).series;
    EXPECT_EQ(fa.at(1).y, fb.at(1).y);
    EXPECT_NE(fa.at(2).y, fb.at(2).y);
}

TEST(PaperPage, has_a_section_for_every_item_and_one_for_the_claims) {
    const report::Page page = paper::paper_page(paper());
    ASSERT_EQ(page.sections.size(), paper().items.size() + 2) << "the claims before them, how it was made after";
    EXPECT_FALSE(page.numbered) << "the numbers are those of the print";
    EXPECT_EQ(page.verdict.find("Of 54 claims of the paper 22 agree"), 0u) << page.verdict;
    const auto& claims = page.sections.front().tables.at(0);
    EXPECT_EQ(claims.rows.size(), paper().claims.size());
    EXPECT_GT(claims.rows.size(), 20u);
}

TEST(VerdictCounts, add_up_to_the_claims) {
    using paper::Claim;
    using paper::Verdict;
    const auto claim = [](Verdict v) { return Claim{"eq (1)", "something", v, "so it is"}; };
    EXPECT_EQ(paper::verdict_counts({claim(Verdict::wrong), claim(Verdict::agrees), claim(Verdict::wrong)}),
              "agrees 1, misprint 0, wrong 2, not supported 0");
    EXPECT_EQ(paper::verdict_counts({}), "agrees 0, misprint 0, wrong 0, not supported 0");
}

}  // namespace zlg::paper_test
