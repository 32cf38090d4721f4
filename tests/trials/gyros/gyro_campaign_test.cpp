#include <zlg/trials/gyro_campaign.hpp>

#include <zlg/config/schema.hpp>

#include "test.hpp"

namespace zlg::trials::gyro_campaign_test {

using config::Fidelity;

// A part of the campaign of docs/accuracy.md: twelve averaged gyros and four lasers.
const std::vector<GyroOutcome>& sample() {
    static const std::vector<GyroOutcome> outcomes =
        run(GyroCampaign{.gyros = 16,
                         .seed = 1,
                         .threads = 2,
                         .fidelities = {Fidelity::averaged, Fidelity::averaged, Fidelity::averaged, Fidelity::laser}});
    return outcomes;
}

TEST(GyroCampaign, ASampleOfBothFidelitiesKeepsTheLimits) {
    EXPECT_EQ(sample().size(), 16u);
    for (const std::string& line : complaints(sample())) ADD_FAILURE() << line;
}

TEST(GyroCampaign, TheSampleSwitchesAndIsValid) {
    std::int64_t switches = 0;
    for (const GyroOutcome& o : sample()) {
        EXPECT_EQ(o.fidelity, o.number % 4 == 3 ? Fidelity::laser : Fidelity::averaged);
        EXPECT_GE(o.ticks, 60 * 100) << "60 s of ticks of 10 ms";
        EXPECT_GT(static_cast<double>(o.valid), 0.99 * static_cast<double>(o.ticks)) << o.command;
        switches += o.judged;
    }
    EXPECT_GT(switches, 100);
}

// All that makes a gyro, its motion and what is done with it; not how a file is read.
TEST(GyroCampaign, EveryKeyThatMakesAGyroIsDrawn) {
    const std::set<std::string> sections{"gyro",  "laser",       "light",     "drift",        "perimeter",
                                         "piezo", "photodiodes", "switching", "compensation", "motion"};
    const std::set<std::string> of_motions{"kind", "rate_arcsec_s", "amplitude_arcsec_s", "frequency_hz", "phase_deg"};
    std::set<std::string> wanted;
    for (const config::KeyInfo& key : config::describe_keys()) {
        // The curve of a laser's discriminator follows from the laser; that of the averaged gyro is straight.
        if (key.name.starts_with("discriminator_") && key.section == "perimeter") continue;
        // Its bias is the paper's parabola and straight in temperature, its quantum noise that of the default power.
        if (key.name == "bias_chi_higher" || key.name == "dispersion" || key.name == "beam_power_w" ||
            key.name == "bias_temperature_table")
            continue;
        if (key.section == "motion" && !of_motions.contains(key.name)) continue;
        if (sections.contains(key.section)) wanted.insert(key.section + "." + key.name);
    }
    // A laser's own constants take a second.
    for (const auto& [fidelity, gyros] : {std::pair{Fidelity::averaged, 40U}, {Fidelity::laser, 8U}})
        for (std::uint64_t number = 0; number < gyros; ++number)
            for (const auto& [key, text] : random_gyro(5, number, fidelity).settings) wanted.erase(key);
    for (const std::string& key : wanted) ADD_FAILURE() << key;
}

TEST(GyroCampaign, HalfOfTheGyrosHaveTheMissThatComesOfItself) {
    int natural = 0;
    for (std::uint64_t number = 0; number < 100; ++number)
        natural += random_gyro(3, number, Fidelity::averaged).config.perimeter.miss_lambda == 0.0;
    EXPECT_NEAR(natural, 50, 20) << "four standard deviations";
}

TEST(GyroCampaign, AGyroIsDrawnFromSeedAndNumberAndItsCommandNamesAll) {
    const GyroTrial trial = random_gyro(9, 4, Fidelity::averaged);
    EXPECT_EQ(trial.settings, random_gyro(9, 4, Fidelity::averaged).settings);
    EXPECT_NE(trial.settings, random_gyro(9, 5, Fidelity::averaged).settings);
    EXPECT_NE(trial.settings, random_gyro(8, 4, Fidelity::averaged).settings);
    const std::string line = command(trial);
    EXPECT_TRUE(line.starts_with("zlg run --set run.seed="));
    config::Config repeated;
    for (std::size_t at = line.find("--set "); at != std::string::npos; at = line.find("--set ", at + 1)) {
        const std::string setting = line.substr(at + 6, line.find(' ', at + 6) - at - 6);
        config::apply_set(repeated, setting);
    }
    if (!repeated.switching.interval_optimal)
        EXPECT_EQ(config::to_settings(repeated), config::to_settings(trial.config));
}

TEST(GyroCampaign, FiguresDoNotDependOnTheThreads) {
    GyroCampaign campaign{.gyros = 3, .seed = 2, .threads = 1};
    const std::string alone = gyros_markdown(run(campaign));
    campaign.threads = 3;
    EXPECT_EQ(alone, gyros_markdown(run(campaign)));
    campaign.gyros = 1;
    campaign.first = 2;
    const std::string last = gyros_markdown(run(campaign));
    EXPECT_TRUE(alone.ends_with(last.substr(last.find("\n| 2 |") + 1)));
}

TEST(GyroCampaign, EveryLimitThatIsNotKeptIsNamed) {
    constexpr std::size_t enough = 50;
    const GyroOutcome good{.ticks = 100, .valid = 99, .judged = 9, .mean_sq_ratio = 1.0, .worst_sigmas = 4.9};
    EXPECT_TRUE(complaints({good}).empty());
    const auto lines = [&](auto GyroOutcome::*figure, auto value) {
        GyroOutcome bad = good;
        bad.*figure = value;
        return complaints({bad}).size();
    };
    EXPECT_EQ(lines(&GyroOutcome::lost, true), 1u);
    EXPECT_EQ(lines(&GyroOutcome::unrepaired, 1), 1u);
    EXPECT_EQ(lines(&GyroOutcome::worst_sigmas, 5.1), 1u);
    EXPECT_EQ(lines(&GyroOutcome::worst_flagged_sigmas, 5.1), 0u) << "it has a flag";
    EXPECT_EQ(lines(&GyroOutcome::not_finite, true), 1u);
    EXPECT_EQ(lines(&GyroOutcome::crash, std::string{"why"}), 1u);
    const auto lines_of_many = [&](double mean_sq_ratio) {
        GyroOutcome bad = good;
        bad.mean_sq_ratio = mean_sq_ratio;
        EXPECT_TRUE(complaints(std::vector(enough - 1, bad)).empty()) << "too few know a median";
        return complaints(std::vector(enough, bad)).size();
    };
    EXPECT_EQ(lines_of_many(1.0), 0u);
    EXPECT_EQ(lines_of_many(0.51), 0u);
    EXPECT_EQ(lines_of_many(0.49), 1u);
    EXPECT_EQ(lines_of_many(1.39), 0u);
    EXPECT_EQ(lines_of_many(1.41), 1u);
    GyroOutcome alarmed = good;
    alarmed.alarms[18] = 1;
    ASSERT_EQ(complaints({alarmed}).size(), 1u);
    EXPECT_NE(complaints({alarmed})[0].find("false alarm: bias_lost"), std::string::npos);
}

}  // namespace zlg::trials::gyro_campaign_test
