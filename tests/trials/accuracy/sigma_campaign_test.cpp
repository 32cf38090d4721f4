#include <zlg/trials/sigma_campaign.hpp>

#include "accuracy/parts.hpp"
#include "accuracy/trial.hpp"
#include "test.hpp"

namespace zlg::trials::sigma_campaign_test {

// A fifth of the campaign.
const std::vector<SigmaFigures>& figures() {
    static const std::vector<SigmaFigures> all = run_sigma_campaign({.share = 0.2, .seed = 1, .threads = 2});
    return all;
}

TEST(SigmaCampaign, IsTrueInEveryClassOfMotion) {
    ASSERT_FALSE(figures().empty());
    // Known to be a third too large: 0.58 of 600 switches in the whole campaign (docs/compensation.md).
    const std::string known = "first gap: sine, by phase";
    for (const SigmaFigures& f : figures())
        EXPECT_TRUE(is_true(f) || (f.motion == known && f.whole.nev < 1.0))
            << f.motion << ", " << f.method << ": " << f.whole.nev << " of " << f.whole.claimed;
}

TEST(SigmaCampaign, EverySwitchHasASigma) {
    for (const SigmaFigures& f : figures()) EXPECT_EQ(f.whole.claimed, f.whole.n) << f.motion << ", " << f.method;
}

ErrorFigures at_rate(double rate_arcsec_s, double scale_arcsec, int gap_ticks, const char* method, double miss) {
    GyroLaw gyro;
    gyro.bias_hz *= 1.003 * gyro.scale_arcsec / scale_arcsec;
    gyro.scale_arcsec = scale_arcsec;
    gyro.gap_ticks = gap_ticks;
    gyro.miss_lambda = miss;
    MotionLaw motion;
    motion.rate_arcsec_s = rate_arcsec_s;
    std::vector<SwitchError> all;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const auto errors = run_trial(
            {.gyro = gyro, .motion = motion, .switches = 150, .learn_ticks = 1500, .interval_ticks = 300, .seed = seed},
            methods_for(config_of(gyro), {method}));
        all.insert(all.end(), errors[0].begin(), errors[0].end());
    }
    return figures_of(all);
}

// Each rate alone: roundings that repeat with it are averaged over no others. 600 switches: a standard error of .06.
TEST(SigmaCampaign, IsTrueAtEachSteadyRate) {
    for (double rate : {0.0, 500.37, 1e5, -2347.55, 0.05, -7.3, 163.15, 217.53}) {
        for (int gap : {3, 6}) {
            const ErrorFigures f = at_rate(rate, 3.263, gap, method_name::automatic_ticks, 0.22);
            EXPECT_GT(f.nev, 0.25) << rate << " " << gap;
            EXPECT_LT(f.nev, 1.4) << rate << " " << gap;
        }
    }
}

// Each case alone within two standard errors, as the campaign judges it; all eight together, 4800 switches, without
// them.
TEST(SigmaCampaign, IsTrueAtRest) {
    double sum = 0.0;
    int cases = 0;
    for (double scale : {3.263, 0.81575}) {
        for (const char* method : {method_name::automatic_ticks, method_name::automatic}) {
            for (double miss : {0.0, 0.22}) {
                const ErrorFigures f = at_rate(0.0, scale, 3, method, miss);
                EXPECT_TRUE(is_true({.whole = f})) << scale << " " << method << " " << miss << ": " << f.nev;
                sum += f.nev;
                ++cases;
            }
        }
    }
    EXPECT_GT(sum / cases, 0.25);
    EXPECT_LT(sum / cases, 1.4);
}

TEST(SigmaCampaign, WhereNotEverySwitchIsClaimedSigmaIsNotTrue) {
    EXPECT_TRUE(is_true({.whole = {.n = 400, .claimed = 400, .nev = 1.0}}));
    EXPECT_FALSE(is_true({.whole = {.n = 400, .claimed = 399, .nev = 1.0}}));
    EXPECT_FALSE(is_true({.whole = {.n = 3}}));
    EXPECT_FALSE(is_true({}));
    EXPECT_FALSE(is_true({.whole = {.n = 4000, .claimed = 4000, .nev = 1.5}}));
}

TEST(SigmaCampaign, ATextHasARowForEachClassAndMethod) {
    const std::string text = campaign_text({{.motion = "rest", .method = "joint", .whole = {.n = 3}}});
    EXPECT_NE(text.find("| rest | joint | 3 |"), std::string::npos);
}

}  // namespace zlg::trials::sigma_campaign_test
