#include <zlg/study/fault_campaign.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace zlg::study {
namespace {

using twin::FaultKind;

// A part of the campaign whose figures the documentation gives: 10 faults of each kind.
const std::vector<FaultFigures>& short_campaign() {
    static const std::vector<FaultFigures> figures = run(FaultCampaign{.faults = 260, .seed = 11, .threads = 2});
    return figures;
}

TEST(FaultCampaign, MeetsEveryKindAndGyrosWithoutFault) {
    const auto& figures = short_campaign();
    ASSERT_EQ(figures.size(), twin::n_fault_kinds + 1);
    EXPECT_EQ(figures.front().kind, "none");
    std::set<std::string> kinds;
    for (const FaultFigures& f : figures) {
        EXPECT_EQ(f.faults, 10) << f.kind;
        kinds.insert(f.kind);
    }
    EXPECT_EQ(kinds.size(), figures.size());
}

TEST(FaultCampaign, NoFaultCrashesOrLetsOutWhatIsNoNumber) {
    for (const FaultFigures& f : short_campaign()) {
        EXPECT_EQ(f.crashed, 0) << f.kind;
        EXPECT_EQ(f.not_finite, 0) << f.kind;
    }
}

TEST(FaultCampaign, AGyroWithoutFaultIsValidAndRightAllTheTime) {
    const FaultFigures& none = short_campaign().front();
    EXPECT_EQ(none.wrong_ticks, 0);
    EXPECT_EQ(none.wrong_bridged, 0);
    EXPECT_EQ(none.recovered, none.faults);
    EXPECT_GT(none.valid_outside_ratio, 0.99);
}

TEST(FaultCampaign, GyrosRecoverAndAreValidAfterwards) {
    for (const FaultFigures& f : short_campaign()) {
        EXPECT_EQ(f.recovered, f.faults) << f.kind;
        EXPECT_GE(f.valid_outside_ratio, 0.99) << f.kind;
    }
}

// What the processor can know of, it knows of.
TEST(FaultCampaign, FaultsThatShowAreDetected) {
    const std::set<std::string> always{"laser_off",       "mode_hop",     "light_nan",      "piezo_adc_nan",
                                       "temperature_nan", "frame_missed", "frame_repeated", "frame_late",
                                       "bias_lost",       "overspeed"};
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

TEST(FaultCampaign, NoValidTickIsWrongButThoseOfAStuckBit) {
    for (const FaultFigures& f : short_campaign()) {
        // A bit that is stuck is no different from rotation until it has shown itself in several halves.
        const std::int64_t allowed = f.kind == "counter_bit_stuck" ? 5 : 0;
        EXPECT_LE(f.with_wrong_ticks, allowed) << f.kind << ": " << f.worst_sigmas << " sigma";
    }
}

TEST(FaultCampaign, TheAngleIsConservedWhereItIsClaimed) {
    const std::set<std::string> listed{"field_pulse"};
    for (const FaultFigures& f : short_campaign()) {
        if (!listed.contains(f.kind)) EXPECT_EQ(f.angle_beyond_5, 0) << f.kind;
    }
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
    ASSERT_EQ(alone.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(same(alone[k], together[k])) << alone[k].kind;
    campaign.seed = 4;
    EXPECT_FALSE(same(alone[1], run(campaign)[1]));
}

TEST(FaultCampaign, ATrialIsDrawnFromItsSeed) {
    for (const FaultKind kind : twin::all_fault_kinds()) {
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

TEST(FaultCampaign, WhatCannotRunIsACrashThatIsTold) {
    FaultTrial trial = random_trial(FaultKind::shock, 5);
    trial.fault->size = 1e9;
    EXPECT_NE(run(trial).crash.find("fault shock: size is"), std::string::npos);
}

TEST(FaultCampaign, TheTableHasARowForEachKind) {
    const std::string table = markdown(short_campaign());
    EXPECT_EQ(std::ranges::count(table, '\n'), 2 + 27);
    EXPECT_NE(table.find("\n| laser_off | 10 | 100.0 % |"), std::string::npos);
    // As many cells in each line.
    EXPECT_EQ(std::ranges::count(table, '|') % (2 + 27), 0);
}

}  // namespace
}  // namespace zlg::study
