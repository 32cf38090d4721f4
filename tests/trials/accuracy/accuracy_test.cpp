#include <zlg/trials/accuracy.hpp>

#include "accuracy/parts.hpp"
#include "test.hpp"

namespace zlg::trials::accuracy_test {

const Accuracy& quick() {
    static const Accuracy accuracy = measure_accuracy({.quick = true, .seed = 3, .threads = 2});
    return accuracy;
}

const CaseFigures* find_case(CaseGroup group, const std::string& name) {
    for (const CaseFigures& c : quick().cases)
        if (c.group == group && c.name == name) return &c;
    return nullptr;
}

// Every criterion at once, each by its own words: a limit is broken only where chance does not explain it.
void meets_what_is_wanted() {
    // What is weak (docs/accuracy.md). Where one is mended its line must go.
    const std::set<std::string> known_misses{"false angle, every loop: bias at most 0.2\"",
                                             "tracked vehicle: at most 1 % beyond 3 sigma",
                                             "another motion from the gap on: NEV at most 3"};
    for (const Criterion& c : quick().criteria)
        EXPECT_EQ(c.verdict == Verdict::missed, known_misses.contains(c.wanted))
            << c.table << ": " << c.wanted << ": " << c.got;
}

void ours_are_better_than_the_paper_in_every_case() {
    for (const CaseFigures& c : quick().cases) {
        const MethodFigures* ours = find_method(c.methods, method_name::automatic);
        ASSERT_NE(ours, nullptr) << c.name;
        // With a motion that changes from tick to tick and nothing learnt a polynomial of few points may be better.
        if (c.name.find("first gap at 10 to 30 ticks") != std::string::npos ||
            c.name.find("first gap at 30 to 60 ticks") != std::string::npos)
            continue;
        for (const MethodFigures& m : c.methods)
            if (m.of_paper) EXPECT_LT(ours->whole.rms_arcsec, 1.05 * m.whole.rms_arcsec) << c.name << ": " << m.method;
    }
}

// Independent trials by other authors: 20.2" (x1), 18.8" (x4) of a quadratic, 109" and 107" of a constant, 83" and 82"
// with no correction of the re-lock.
void the_papers_methods_err_as_others_found() {
    const auto rms = [](const char* counts, const char* method) {
        const CaseFigures* c = find_case(CaseGroup::paper, std::string{"20.06 Hz, 12 000 \"/s, "} + counts);
        return c == nullptr ? 0.0 : find_method(c->methods, method)->whole.rms_arcsec;
    };
    EXPECT_NEAR(rms("x1", method_name::quadratic), 20.2, 1.5);
    EXPECT_NEAR(rms("x4", method_name::quadratic), 18.8, 1.5);
    EXPECT_NEAR(rms("x1", method_name::detuning_constant), 109.0, 7.0);
    EXPECT_NEAR(rms("x4", method_name::detuning_constant), 107.0, 7.0);
    EXPECT_NEAR(rms("x1", method_name::uncorrected), 83.0, 2.5);
    EXPECT_NEAR(rms("x4", method_name::uncorrected), 82.0, 2.5);
}

void all_figures_are_finite() {
    for (const CaseFigures& c : quick().cases) {
        for (const MethodFigures& m : c.methods) {
            EXPECT_TRUE(std::isfinite(m.whole.rms_arcsec) && std::isfinite(m.whole.nev)) << c.name << ": " << m.method;
            EXPECT_EQ(m.whole.claimed, m.whole.n) << c.name << ": " << m.method;
        }
    }
}

void the_text_has_a_table_for_each_group() {
    const std::string text = markdown(quick());
    for (const char* heading :
         {"## Wanted and got", "## (a)", "## (c)", "## (d)", "## (f)", "## (g)", "## (h)", "## (i)"})
        EXPECT_NE(text.find(heading), std::string::npos) << heading;
    EXPECT_EQ(text.find("nan"), std::string::npos);
}

// One test of one campaign, which takes a minute; a sanitizer sees the same code in the shorter one below.
TEST(Accuracy, TheQuickCampaignMeetsWhatIsWanted) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "ten minutes with a sanitizer";
#endif
    meets_what_is_wanted();
    ours_are_better_than_the_paper_in_every_case();
    the_papers_methods_err_as_others_found();
    all_figures_are_finite();
    the_text_has_a_table_for_each_group();
}

// A rate that grows evenly is met exactly by every polynomial, for the points lie symmetrically about the gap.
TEST(AccuracyRecording, ASteadyAccelerationIsMet) {
    const auto path = std::filesystem::path{testing::TempDir()} / "accuracy_recording.txt";
    {
        std::ofstream out{path};
        out << "% rows of counts\n";
        for (int k = 0; k < 3000; ++k) out << 1000 + k << "\n";
    }
    Recording r{.name = "ramp", .path = path.string(), .columns = {1}, .rate_hz = 200.0};
    r.scale_arcsec = 0.1;
    r.first_gap_tick = 300;
    const RecordingFigures figures = measure_recording(r);
    std::filesystem::remove(path);
    ASSERT_EQ(figures.axes.size(), 1u);
    for (const MethodFigures& m : figures.axes[0].methods) {
        EXPECT_GT(m.whole.n, 20) << m.method;
        EXPECT_LT(m.whole.worst_arcsec, m.of_paper ? 1e-6 : 0.3) << m.method;
    }
}

Recording swaying_base() {
    return {.name = "swaying base",
            .path = std::string{ZLG_SHARED_DIR} + "/data/lasergyro.imu",
            .skip_lines = 3,
            .scale_arcsec = 0.1};
}

// A constant is three quarters of the sum of the two ticks on either side: no code of ours is needed to know its error.
double error_of_a_constant(const std::string& path) {
    std::ifstream in{path};
    std::vector<double> x;
    int header = 3;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with('%') || line.find_first_not_of(" \r") == std::string::npos) continue;
        if (header-- > 0) continue;
        x.push_back(0.1 * std::stod(line));
    }
    double sum = 0.0;
    int n = 0;
    for (std::size_t t = 2040; t + 67 < x.size(); t += 97, ++n) {
        const double error = 0.75 * (x[t - 2] + x[t - 1] + x[t + 3] + x[t + 4]) - (x[t] + x[t + 1] + x[t + 2]);
        sum += error * error;
    }
    return std::sqrt(sum / n);
}

TEST(AccuracyRecording, AutoIsBetterOnRealMotion) {
    const Recording recording = swaying_base();
    if (!std::filesystem::exists(recording.path)) GTEST_SKIP() << "no recording of real motion at " << recording.path;
    Accuracy accuracy;
    accuracy.recordings = {measure_recording(recording)};
    ASSERT_EQ(accuracy.recordings[0].axes.size(), 3u);
    EXPECT_NEAR(find_method(accuracy.recordings[0].axes[0].methods, "constant")->whole.rms_arcsec,
                error_of_a_constant(recording.path), 1e-6);
    int judged = 0;
    for (const Criterion& c : criteria_of(accuracy)) {
        if (c.wanted.find(recording.name) == std::string::npos) continue;
        ++judged;
        EXPECT_EQ(c.verdict, Verdict::met) << c.wanted << ": " << c.got;
    }
    EXPECT_EQ(judged, 4);
}

TEST(Accuracy, FiguresDoNotDependOnTheThreads) {
    const Accuracy alone = measure_accuracy({.quick = true, .share = 0.05, .seed = 3, .threads = 1});
    const Accuracy together = measure_accuracy({.quick = true, .share = 0.05, .seed = 3, .threads = 3});
    EXPECT_EQ(markdown(alone), markdown(together));
}

}  // namespace zlg::trials::accuracy_test
