// Windows whose estimate is known in closed form; drawn ones are held against NumPy in tests/core/test_estimate.py.

#include <zlg/core/compensation/switch_estimate.hpp>

#include "support.hpp"

namespace zlg::core::switch_estimate_test {

constexpr double rate = 7.5;  // arcsec in a half
constexpr int gap_halves = 6;
constexpr int before_halves = 16;
constexpr int after_halves = 24;
constexpr int points = before_halves + after_halves;

// No bias, no noise of readings: what is left is the walk of the angle, the same for every half.
CompensationConstants quiet_gyro() {
    CompensationConstants gyro;
    gyro.bias = Hertz{0.0};
    gyro.random_walk = ArcsecPerRootSecond{0.2};
    gyro.fringe_noise_counts = 0.0;
    return gyro;
}

const double walk_of_half = 0.2 * 0.2 * 0.0025;

// Halves before and after a gap that is one row; the readings are an even rate.
SwitchWindow even_window() {
    SwitchWindow window{.gap = {before_halves, before_halves + gap_halves}, .with_phase = true};
    const auto add = [&](int halves, bool read) {
        window.row[static_cast<unsigned>(window.n_rows++)] = {.halves = {window.n_halves, window.n_halves + halves},
                                                              .read = read,
                                                              .wanted = !read,
                                                              .after_gap = window.n_halves >= before_halves,
                                                              .y_arcsec = read ? rate : 0.0};
        window.n_halves += halves;
    };
    for (int h = 0; h < before_halves; ++h) add(1, true);
    add(gap_halves, false);
    for (int h = 0; h < after_halves; ++h) add(1, true);
    window.bias_sign.fill(1);
    return window;
}

MotionMoments nothing_moves(const SwitchWindow& window) { return {.length = window.n_halves, .n_windows = 1000.0}; }

SwitchEstimate estimate_of(const CompensationConstants& gyro, const SwitchWindow& window,
                           const RelockScale& scale = {.value = 0.0, .variance = 0.0},
                           std::span<const BankMember> bank = {}) {
    const auto room = std::make_unique<EstimateRoom>();
    return estimate(gyro, window, nothing_moves(window), scale, *room, bank);
}

void expect_angle(const SwitchEstimate& found, double angle, double variance) {
    EXPECT_TRUE(found.known);
    EXPECT_NEAR(found.angle_arcsec, angle, 1e-6);
    EXPECT_NEAR(found.variance_arcsec2, variance, 1e-6 * variance);
}

// The walk over G halves, and G times the error of a mean of n halves.
double variance_of(double halves, double n) { return walk_of_half * (halves + halves * halves / n); }

TEST(SwitchEstimate, TheMeanRateGoesOnOverTheGap) {
    expect_angle(estimate_of(quiet_gyro(), even_window()), gap_halves * rate, variance_of(gap_halves, points));
}

TEST(SwitchEstimate, ASumThatTheCounterKnowsIsOneMoreReading) {
    SwitchWindow window = even_window();
    for (int r = window.n_rows; r > before_halves + 1; --r)
        window.row[static_cast<unsigned>(r)] = window.row[static_cast<unsigned>(r - 1)];
    ++window.n_rows;
    WindowRow& known = window.row[before_halves];
    WindowRow& missed = window.row[before_halves + 1];
    known = {.halves = {before_halves, before_halves + 4}, .read = true, .y_arcsec = 4.0 * rate + 1.2};
    missed = {.halves = {before_halves + 4, before_halves + gap_halves}, .wanted = true};
    expect_angle(estimate_of(quiet_gyro(), window), 2.0 * (rate + 1.2 / (points + 4)), variance_of(2, points + 4));
}

// An unknown step weighs either side of the gap alike, however many points it has.
TEST(SwitchEstimate, AMagneticStepThatIsNotKnownLeavesTheMeanOfBothSides) {
    SwitchWindow window = even_window();
    window.magnetic_variance_arcsec2 = 1e4;
    for (WindowRow& row : window.row)
        if (row.after_gap && row.read) row.y_arcsec += 0.8;
    const double of_rate = walk_of_half * (1.0 / before_halves + 1.0 / after_halves) / 4.0;
    const SwitchEstimate found = estimate_of(quiet_gyro(), window);
    EXPECT_NEAR(found.angle_arcsec, gap_halves * (rate + 0.4), 1e-5);
    EXPECT_NEAR(found.variance_arcsec2, gap_halves * walk_of_half + gap_halves * gap_halves * of_rate, 1e-6);
}

// The mean rate is one estimate of them all, and the best is no worse: what the roundings at its four ends add, should
// they go together, is a bound.
TEST(SwitchEstimate, RoundingsOfTheCounterAddToTheVariance) {
    SwitchWindow window = even_window();
    const CompensationConstants gyro = quiet_gyro();
    const double by_phase = estimate_of(gyro, window).variance_arcsec2;
    window.with_phase = false;
    const double count = gyro.scale.value();
    const double by_counts = estimate_of(gyro, window).variance_arcsec2;
    const double ratio = double{gap_halves} / points;
    const double diagonal = 0.01 * count * count / 12.0;  // least_of_reading
    EXPECT_GT(by_counts, by_phase);
    EXPECT_LT(by_counts, by_phase + ratio * ratio * count * count * 4.0 / 3.0 + diagonal * gap_halves * (1.0 + ratio));
}

// Rows after the gap that turn by a false angle k dl^2 with the sign of the bias; dl does not change.
struct Relocking {
    CompensationConstants gyro = quiet_gyro();
    SwitchWindow window = even_window();
    double false_arcsec = 0.0;  // of a half
};

Relocking relocking(double chi_ratio) {
    Relocking r;
    constexpr double dl = 0.05;
    r.gyro.bias = Hertz{60e3};
    r.gyro.light_noise = Wavelengths{1e-9};
    r.false_arcsec = r.gyro.chi * 60e3 * r.gyro.scale.value() * r.gyro.tick.value() / 2.0 * dl * dl;
    r.window.light_start = r.window.gap.last;
    r.window.light.basis = light_basis(after_halves);
    const std::vector<double> samples(16, dl);
    for (int h = 0; h < after_halves; ++h) add(r.window.light, h, samples);
    for (int h = r.window.light_start; h < r.window.n_halves; ++h)
        r.window.bias_sign[static_cast<unsigned>(h)] = h % 4 < 2 ? 1 : -1;
    for (WindowRow& row : r.window.row) {
        if (!row.after_gap || !row.read) continue;
        row.wanted = true;
        row.y_arcsec =
            rate - chi_ratio * r.false_arcsec * r.window.bias_sign[static_cast<std::size_t>(row.halves.first)];
    }
    return r;
}

TEST(SwitchEstimate, FalseAnglesComeOffByTheLight) {
    const Relocking r = relocking(1.0);
    const SwitchEstimate found = estimate_of(r.gyro, r.window);
    EXPECT_NEAR(found.angle_arcsec, (gap_halves + after_halves) * rate, 1e-4);
    for (int n = before_halves + 1; n < r.window.n_rows; ++n)
        EXPECT_NEAR(found.row[static_cast<unsigned>(n)].angle_arcsec, rate, 1e-4);
}

// With a steady detuning the false angles look as an error of the bias does, 1e-4 of it: chi dl^2 against that.
TEST(SwitchEstimate, TheScaleOfTheFalseAnglesIsLearnt) {
    const Relocking r = relocking(1.05);
    const RelockScale before{};
    const SwitchEstimate found = estimate_of(r.gyro, r.window, before);
    const double of_bias = std::pow(1e-4 / (r.gyro.chi * 0.05 * 0.05), 2);
    EXPECT_NEAR(found.scale.value, 0.05 * before.variance / (before.variance + of_bias), 1e-5);
    EXPECT_NEAR(found.scale.variance, before.variance * of_bias / (before.variance + of_bias), 1e-6);
    EXPECT_NEAR(found.angle_arcsec, (gap_halves + after_halves) * rate, 0.01);
}

// Halves of a rate whose slope changes: the mean of all is far off, a walk of the slope of the slope is not.
TEST(SwitchEstimate, TheBankFollowsAMotionThatWasNotLearnt) {
    SwitchWindow window = even_window();
    const auto angle = [](int h) { return 0.02 * (h - 19) * (h - 19); };
    double truth = 0.0;
    for (int h = window.gap.first; h < window.gap.last; ++h) truth += angle(h);
    for (WindowRow& row : window.row)
        if (row.read) row.y_arcsec = angle(row.halves.first);
    EXPECT_GT(std::abs(estimate_of(quiet_gyro(), window).angle_arcsec - truth), 10.0);
    const SwitchEstimate found = estimate_of(quiet_gyro(), window, {.value = 0.0, .variance = 0.0}, motion_bank);
    EXPECT_NEAR(found.angle_arcsec, truth, 3.0 * std::sqrt(found.variance_arcsec2));
    EXPECT_LT(found.variance_arcsec2, 0.01);
}

TEST(SwitchEstimate, RowsAddUpToTheAngle) {
    const Relocking r = relocking(1.02);
    const SwitchEstimate found = estimate_of(r.gyro, r.window, RelockScale{}, motion_bank);
    double sum = 0.0;
    for (const RowEstimate& row : found.row) sum += row.angle_arcsec;
    EXPECT_NEAR(sum, found.angle_arcsec, 1e-9);
}

TEST(SwitchEstimate, MomentsThatAreNoCovarianceMakeNoEstimate) {
    const SwitchWindow window = even_window();
    MotionMoments motion = nothing_moves(window);
    motion.sum[0] = -1e6;
    const auto room = std::make_unique<EstimateRoom>();
    EXPECT_FALSE(estimate(quiet_gyro(), window, motion, RelockScale{}, *room).known);
}

TEST(SwitchEstimate, AReadingThatIsNotFiniteIsNotBelieved) {
    SwitchWindow window = even_window();
    window.row[3].y_arcsec = INFINITY;
    const SwitchEstimate found = estimate_of(quiet_gyro(), window, RelockScale{}, motion_bank);
    EXPECT_FALSE(found.known);
    EXPECT_EQ(found.scale, RelockScale{});
}

}  // namespace zlg::core::switch_estimate_test
