#include <zlg/trials/fault_campaign.hpp>

#include "test.hpp"

namespace zlg::trials::fault_campaign_test {

using twin::FaultKind;

// A part of the campaign whose figures the documentation gives: 5 faults of each kind.
const std::vector<FaultFigures>& short_campaign() {
    static const std::vector<FaultFigures> figures = run(FaultCampaign{.faults = 130, .seed = 11, .threads = 2});
    return figures;
}

TEST(FaultCampaign, MeetsEveryKindAndGyrosWithoutFault) {
    const auto& figures = short_campaign();
    ASSERT_EQ(figures.size(), twin::n_fault_kinds + 3);
    EXPECT_EQ(figures.front().kind, "none");
    EXPECT_EQ(figures.back().kind, "all");
    EXPECT_EQ(figures.back().faults, 135) << "two at once among them";
    std::set<std::string> kinds;
    for (const FaultFigures& f : figures) {
        if (f.kind != "all") EXPECT_EQ(f.faults, 5) << f.kind;
        kinds.insert(f.kind);
    }
    EXPECT_EQ(kinds.size(), figures.size());
}

TEST(FaultCampaign, AGyroWithoutFaultIsValidAndRightAllTheTime) {
    const FaultFigures& none = short_campaign().front();
    EXPECT_EQ(none.wrong_ticks, 0);
    EXPECT_EQ(none.wrong_bridged, 0);
    EXPECT_EQ(none.recovered, none.faults);
    EXPECT_GT(none.valid_outside_ratio, 0.99);
}

TEST(FaultCampaign, GyrosRecoverAndAreValidAfterwards) {
    for (const std::string& line : complaints(short_campaign())) ADD_FAILURE() << line;
    for (const FaultFigures& f : short_campaign()) EXPECT_GE(f.valid_outside_ratio, 0.99) << f.kind;
}

// Durations of a fault are those that a gyro may meet, not only those that it outlives at once.
TEST(FaultCampaign, FaultsLastFromAMillisecondToAMinute) {
    double shortest_s = 1.0;
    double longest_s = 1.0;
    int below_a_second = 0;
    std::set<config::MotionKind> motions;
    std::set<config::Loop> loops;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        const FaultTrial trial = random_trial(FaultKind::bias_lost, seed);
        shortest_s = std::min(shortest_s, trial.fault->duration_s);
        longest_s = std::max(longest_s, trial.fault->duration_s);
        below_a_second += trial.fault->duration_s < 1.0;
        motions.insert(trial.config.motion.kind);
        loops.insert(trial.config.perimeter.loop);
    }
    EXPECT_GE(shortest_s, 1e-3);
    EXPECT_LT(shortest_s, 1.2e-3);
    EXPECT_LE(longest_s, 60.0);
    EXPECT_GT(longest_s, 50.0);
    EXPECT_NEAR(below_a_second, 1000.0 * std::log(1e3) / std::log(6e4), 60.0) << "four standard deviations";
    EXPECT_EQ(motions.size(), 3u);
    EXPECT_EQ(loops.size(), 3u);
}

// The fault of the review, in the closed loop: what the coil lost for longer than a second was never seen to come back.
TEST(FaultCampaign, ABiasCurrentLostForLongerThanASecondComesBack) {
    for (const double size : {0.4, 0.95, 1.0}) {
        for (const double duration_s : {1.5, 20.0}) {
            FaultTrial trial = random_trial(FaultKind::bias_lost, 3);
            trial.fault = twin::Fault{FaultKind::bias_lost, 3.0, duration_s, size};
            trial.watched_s = 4.0 + duration_s;
            trial.end_s = 7.5 + duration_s;
            const FaultOutcome out = run(trial);
            EXPECT_TRUE(out.recovered) << size << " for " << duration_s << " s";
            EXPECT_GT(out.valid_after, 0.99 * static_cast<double>(out.ticks_after));
        }
    }
}

// Default motion, by phase. What comes late holds the rotation of the half before.
TEST(FaultCampaign, FramesThatStayLateAreNeverTakenForThoseOfTheirHalf) {
    FaultTrial trial;
    trial.config.gyro.readout = config::Readout::phase;
    trial.fault = twin::Fault{FaultKind::frame_late, 3.0, 85.0, 0.0};
    trial.watched_s = 89.0;
    trial.end_s = 92.0;
    const FaultOutcome out = run(trial);
    EXPECT_EQ(out.wrong, 0);
    EXPECT_TRUE(out.recovered);
}

TEST(FaultCampaign, AStuckBitZeroIsFoundByPhase) {
    for (const auto motion : {config::MotionKind::constant, config::MotionKind::sine}) {
        FaultTrial trial;
        trial.config.gyro.readout = config::Readout::phase;
        trial.config.motion.kind = motion;
        trial.config.motion.rate_arcsec_s = 1000.0;
        trial.fault = twin::Fault{FaultKind::counter_bit_stuck, 10.0, 20.0, 0.0};
        trial.watched_s = 31.0;
        trial.end_s = 33.0;
        const FaultOutcome out = run(trial);
        EXPECT_TRUE(out.detected);
        EXPECT_LE(out.wrong, 60) << "of 4000 ticks";
        EXPECT_TRUE(out.recovered);
    }
}

// The light shows the squares of the detuning through its noise: what that hides is in sigma.
TEST(FaultCampaign, ASwingingPerimeterIsWithinSigmaByPhase) {
    FaultTrial trial;
    trial.config.gyro.readout = config::Readout::phase;
    trial.config.motion.kind = config::MotionKind::rest;
    for (const auto& [kind, size] : {std::pair{FaultKind::vibration, 0.05}, {FaultKind::light_noisy, 0.07}}) {
        trial.fault = twin::Fault{kind, 10.0, 20.0, size};
        trial.watched_s = 31.0;
        trial.end_s = 33.0;
        EXPECT_EQ(run(trial).wrong, 0) << twin::facts(kind).name;
    }
}

TEST(FaultCampaign, OnABenchLightDiffersFaultsLastAndManyActAtOnce) {
    int from_power_up = 0, by_phase = 0;
    std::size_t most = 0;
    double longest_s = 0.0, widest = 1.0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        const FaultTrial trial =
            random_trial(FaultKind::shock, seed, config::Fidelity::averaged, true, Surroundings::bench);
        most = std::max(most, trial.others.size());
        EXPECT_GE(trial.others.size(), 1u);
        from_power_up += trial.fault->at_s == 0.0;
        by_phase += trial.config.gyro.readout == config::Readout::phase;
        longest_s = std::max(longest_s, trial.fault->duration_s);
        widest = std::max(widest, trial.config.light.gain_b);
    }
    EXPECT_EQ(most, 5u);
    EXPECT_NEAR(from_power_up, 60, 28);
    EXPECT_NEAR(by_phase, 100, 33);
    EXPECT_GT(longest_s, 200.0);
    EXPECT_GT(widest, 1.35);
}

// Right after a closing, where a re-lock falsifies the sum of the counter: at 15 ms after the opening the loop is
// closed.
TEST(FaultCampaign, AJerkRightAfterASwitchIsWithinSigma) {
    for (const auto readout : {config::Readout::counts, config::Readout::phase}) {
        for (const auto relock : {core::RelockMethod::mean_square, core::RelockMethod::joint}) {
            for (int k = 0; k < 20; ++k) {
                FaultTrial trial;
                trial.config.motion.kind = config::MotionKind::rest;
                trial.config.switching.interval_s = 2.0;
                trial.config.gyro.readout = readout;
                trial.config.compensation.relock = relock;
                const double at_s = 2.0125 + 0.0025 * k;
                trial.fault = twin::Fault{FaultKind::overspeed, at_s, k % 2 == 0 ? 0.005 : 0.01, 500'000.0};
                trial.watched_s = 2.2;
                trial.end_s = 3.0;
                const FaultOutcome out = run(trial);
                EXPECT_EQ(out.wrong + out.wrong_bridged, 0) << at_s;
                EXPECT_LT(std::abs(out.angle_error_arcsec), 5.0 * out.angle_sigma_arcsec) << at_s;
            }
        }
    }
}

// What the processor can know of, it knows of.
TEST(FaultCampaign, FaultsThatShowAreDetected) {
    const std::set<std::string> always{"laser_off",       "light_nan",    "piezo_adc_nan",
                                       "temperature_nan", "frame_missed", "frame_repeated",
                                       "frame_late",      "bias_lost",    "overspeed"};
    for (const FaultFigures& f : short_campaign()) {
        if (always.contains(f.kind)) EXPECT_EQ(f.detected, f.faults) << f.kind;
    }
}

// A constant field is a drift like any other: nothing in the gyro tells it.
TEST(FaultCampaign, AFieldPulseIsNotDetected) {
    for (const FaultFigures& f : short_campaign()) {
        if (f.kind == "field_pulse") EXPECT_EQ(f.detected, 0);
    }
}

// But where the error of a stuck bit comes or goes: no sigma is about it (docs/faults.md).
TEST(FaultCampaign, NoValidTickIsFarOff) {
    for (const FaultFigures& f : short_campaign())
        if (f.kind != "counter_bit_stuck" && f.kind != "all") EXPECT_LT(f.worst_sigmas, 6.0) << f.kind;
}

TEST(FaultCampaign, TheAngleIsConservedWhereItIsClaimed) {
    // A field looks like a rotation. A rate beyond the counter's range loses angle, but claims none.
    std::int64_t of_fields = 0;
    for (const FaultFigures& f : short_campaign()) {
        if (f.kind == "field_pulse")
            of_fields = f.angle_beyond_5;
        else
            EXPECT_EQ(f.angle_beyond_5, f.kind == "all" ? of_fields : 0) << f.kind;
    }
}

TEST(FaultCampaign, EveryLimitThatIsNotKeptIsNamed) {
    const FaultFigures good{
        .kind = "all", .faults = 9, .valid_outside_ratio = 0.996, .mean_sq_ratio = 0.7, .recovered = 9};
    EXPECT_TRUE(complaints({good}).empty());
    const auto lines = [&](auto FaultFigures::*figure, auto value) {
        FaultFigures bad = good;
        bad.*figure = value;
        return complaints({bad}).size();
    };
    EXPECT_EQ(lines(&FaultFigures::recovered, 8), 1u);
    EXPECT_EQ(lines(&FaultFigures::not_finite, 1), 1u);
    EXPECT_EQ(lines(&FaultFigures::crashed, 1), 1u);
    EXPECT_EQ(lines(&FaultFigures::valid_outside_ratio, 0.9949), 1u);
    EXPECT_EQ(lines(&FaultFigures::mean_sq_ratio, 0.49), 1u);
    EXPECT_EQ(lines(&FaultFigures::mean_sq_ratio, 1.51), 1u);
    EXPECT_EQ(lines(&FaultFigures::mean_sq_ratio, std::nan("")), 1u);
    FaultFigures of_a_kind = good;
    of_a_kind.kind = "shock";
    of_a_kind.valid_outside_ratio = 0.99;
    EXPECT_TRUE(complaints({of_a_kind}).empty()) << "few faults of a kind know that by chance only";
    of_a_kind.recovered = 8;
    EXPECT_EQ(complaints({of_a_kind}).size(), 1u);
}

bool same(const FaultFigures& a, const FaultFigures& b) {
    return a.kind == b.kind && a.faults == b.faults && a.detected == b.detected &&
           a.median_latency_s == b.median_latency_s && a.valid_outside_ratio == b.valid_outside_ratio &&
           a.worst_sigmas == b.worst_sigmas && a.angle_rms_arcsec == b.angle_rms_arcsec && a.recovered == b.recovered &&
           a.claimed == b.claimed;
}

TEST(FaultCampaign, FiguresDependOnTheSeedAndNotOnTheThreads) {
    FaultCampaign campaign{.faults = 8, .seed = 3, .threads = 1, .kinds = {FaultKind::laser_off, FaultKind::shock}};
    const auto alone = run(campaign);
    campaign.threads = 3;
    const auto together = run(campaign);
    ASSERT_EQ(alone.size(), 5u);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_TRUE(same(alone[k], together[k])) << alone[k].kind;
    campaign.seed = 4;
    EXPECT_FALSE(same(alone[1], run(campaign)[1]));
}

TEST(FaultCampaign, ATrialIsDrawnFromItsSeed) {
    for (const FaultKind kind : twin::all_fault_kinds) {
        const FaultTrial trial = random_trial(kind, 42);
        const FaultTrial again = random_trial(kind, 42);
        ASSERT_TRUE(trial.fault.has_value());
        EXPECT_EQ(trial.fault->kind, kind);
        EXPECT_EQ(trial.fault->size, again.fault->size);
        EXPECT_EQ(trial.config.run.seed, again.config.run.seed);
        EXPECT_NE(trial.config.run.seed, random_trial(kind, 43).config.run.seed);
        // A second for the gyro to come back, and another one in which it must be back.
        EXPECT_GE(trial.watched_s, trial.fault->at_s + trial.fault->duration_s + 1.0);
        EXPECT_GT(trial.end_s, trial.watched_s + 1.0);
    }
    EXPECT_FALSE(random_trial(std::nullopt, 42).fault.has_value());
}

// Five frames: known to the half.
TEST(FaultCampaign, OneTrialTellsWhatWasAsked) {
    FaultTrial trial = random_trial(FaultKind::frame_missed, 5);
    trial.fault = twin::Fault{FaultKind::frame_missed, 3.0001, 0.0125, 0.0};
    trial.watched_s = 4.0125;
    trial.end_s = 5.5;
    const FaultOutcome out = run(trial);
    EXPECT_TRUE(out.detected);
    EXPECT_NEAR(out.latency_s, 0.0024, 1e-9) << "the half that ends at 3.0025 s is the first whose frame is missed";
    EXPECT_EQ(out.ticks_outside, 600 + 1100 - 803);
    EXPECT_TRUE(out.recovered);
    EXPECT_EQ(out.wrong, 0);
    EXPECT_LT(std::abs(out.angle_error_arcsec), 5.0 * out.angle_sigma_arcsec);
}

TEST(FaultCampaign, WhatCannotRunIsACrashThatIsNamed) {
    FaultTrial trial = random_trial(FaultKind::shock, 5);
    trial.fault->size = 1e9;
    EXPECT_NE(run(trial).crash.find("fault shock: faults.size is"), std::string::npos);
}

TEST(FaultCampaign, TheTableHasARowForEachKind) {
    const std::string table = markdown(short_campaign());
    EXPECT_EQ(std::ranges::count(table, '\n'), 2 + 29);
    EXPECT_NE(table.find("\n| laser_off | 5 | 100.0 % |"), std::string::npos);
    // As many cells in each line.
    EXPECT_EQ(std::ranges::count(table, '|') % (2 + 29), 0);
}

}  // namespace zlg::trials::fault_campaign_test
