// Rules between keys.
#include "schema_support.hpp"

namespace zlg::config::schema_rules_test {

using twin::FaultKind;

TEST(Schema, ABridgeNeedsOnePointMoreThanItsOrder) {
    EXPECT_EQ(check_complaint({"compensation.bridge=quadratic", "compensation.extrapolation_points=2"}),
              "compensation.bridge = \"quadratic\": a bridge of order 2 needs 3 points, but "
              "compensation.extrapolation_points is 2");
    // Where nothing is known of the motion yet, "auto" is quadratic too.
    expect_contains(check_complaint({"compensation.bridge=auto", "compensation.extrapolation_points=2"}),
                    "compensation.bridge = \"auto\": a bridge of order 2 needs 3 points");
    expect_contains(check_complaint({"compensation.points_before=1", "compensation.points_after=1"}),
                    "order 2 needs 3 points, but compensation.points_before + points_after is 2");
    expect_contains(check_complaint({"compensation.bridge=linear", "compensation.extrapolation_points=1"}),
                    "needs 2 points");
    EXPECT_NO_THROW(check(with({"compensation.bridge=linear", "compensation.extrapolation_points=2"})));
    EXPECT_NO_THROW(check(with({"compensation.bridge=constant", "compensation.extrapolation_points=1",
                                "compensation.points_before=1", "compensation.points_after=1"})));
    EXPECT_NO_THROW(check(with({"compensation.points_before=1"})));
}

TEST(Schema, AMotionHasAsManyFrequenciesAndPhasesAsAmplitudes) {
    expect_contains(check_complaint({"motion.kind=sum", "motion.amplitude_arcsec_s=[1, 2, 3]"}),
                    "motion.amplitude_arcsec_s: 3 numbers, motion.frequency_hz: 1, motion.phase_deg: 1");
    EXPECT_NO_THROW(check(with({"motion.kind=sum", "motion.amplitude_arcsec_s=[1, 2]", "motion.frequency_hz=[1, 2]"})))
        << "one phase serves all";
    EXPECT_THROW(check(with({"motion.kind=sum", "motion.amplitude_arcsec_s=[1, 2, 3]", "motion.frequency_hz=[1, 2, 3]",
                             "motion.phase_deg=[0, 90]"})),
                 ConfigError);
    EXPECT_NO_THROW(check(with({"motion.kind=sum", "motion.amplitude_arcsec_s=[1, 2]", "motion.frequency_hz=[1, 2]",
                                "motion.phase_deg=[0, 90]"})));
    expect_contains(
        check_complaint({"motion.amplitude_arcsec_s=[1, 2]", "motion.frequency_hz=[1, 2]", "motion.phase_deg=[0, 90]"}),
        "motion.kind = \"sine\" has one");
    EXPECT_NO_THROW(check(with({"motion.kind=rest", "motion.amplitude_arcsec_s=[1, 2]"})));
}

TEST(Schema, AMotionFileNeedsAPath) {
    expect_contains(check_complaint({"motion.kind=file"}), "motion.path");
    EXPECT_NO_THROW(check(with({"motion.kind=file", "motion.path=a.txt"})));
}

TEST(Schema, AnIntervalHoldsItsGapAndTwoTicksMore) {
    expect_contains(check_complaint({"gyro.tick_s=1", "switching.interval_s=4.5"}), "gap_ticks + 2 = 5 ticks");
    EXPECT_NO_THROW(check(with({"gyro.tick_s=1", "switching.interval_s=5"})));
    EXPECT_NO_THROW(check(with({"gyro.tick_s=10", "switching.gap_ticks=16", "switching.interval_s=optimal"})));
}

TEST(Schema, AReversalEndsWithinItsHalf) {
    expect_contains(check_complaint({"gyro.bias_edge_s=0.0025"}), "below half of gyro.tick_s = 0.005");
    EXPECT_NO_THROW(check(with({"gyro.bias_edge_s=0.0024"})));
    EXPECT_NO_THROW(check_compensation(with({"gyro.tick_s=1e-6"}))) << "no matter of a recorded log";
}

TEST(Schema, ThePiezoRangeIsNotEmpty) {
    expect_contains(check_complaint({"piezo.range_min_v=300"}), "below piezo.range_max_v = 300");
}

TEST(Schema, ADiscriminatorIsAsManyDetuningsAsSignalsAndBothGrow) {
    const Config c =
        from_toml("[perimeter]\ndiscriminator_detuning_lambda = [0.1, 0.2]\ndiscriminator_signal = [0.04, 0.13]\n");
    EXPECT_NO_THROW(check(c));
    EXPECT_EQ(c.perimeter.discriminator_signal, (std::vector<double>{0.04, 0.13}));
    Config again;
    apply_toml(again, to_toml(c), "again.toml");
    EXPECT_EQ(to_settings(again), to_settings(c));

    EXPECT_NO_THROW(check(with({"perimeter.discriminator_signal=[]"})));
    expect_contains(check_complaint({"perimeter.discriminator_signal=[0.1, 0.2]"}),
                    "perimeter.discriminator_detuning_lambda: 0 numbers, perimeter.discriminator_signal: 2");
    expect_contains(check_complaint({"perimeter.discriminator_detuning_lambda=[0.1, 0.1]",
                                     "perimeter.discriminator_signal=[0.1, 0.2]"}),
                    "perimeter.discriminator_detuning_lambda: 0.1 after 0.1; allowed is growth");
    expect_contains(check_complaint({"perimeter.discriminator_detuning_lambda=[0.1, 0.2]",
                                     "perimeter.discriminator_signal=[0.2, 0.1]"}),
                    "perimeter.discriminator_signal: 0.1 after 0.2");
    expect_contains(set_complaint("perimeter.discriminator_signal=[0.1, 2000]"), "[] included, each -1000..1000");
    expect_contains(
        check_complaint(
            {"perimeter.discriminator_detuning_lambda=[0, 0.2]", "perimeter.discriminator_signal=[0.1, 0.2]"}),
        "discriminator_signal is 0.1 at discriminator_detuning_lambda 0; allowed is the same sign, and not 0");
    std::string many = "[1";
    for (int k = 2; k <= 32; ++k) many += ", " + std::to_string(k);
    const std::string detunings = "perimeter.discriminator_detuning_lambda=" + many + "]";
    const std::string signals = "perimeter.discriminator_signal=" + many + "]";
    expect_contains(check_complaint({detunings, signals}), "31 at most");
}

TEST(Schema, ADiscriminatorMayHaveTwoSides) {
    EXPECT_NO_THROW(check(with({"perimeter.discriminator_detuning_lambda=[-0.2, -0.1, 0.1]",
                                "perimeter.discriminator_signal=[-0.3, -0.1, 0.2]"})));
    expect_contains(check_complaint({"perimeter.discriminator_detuning_lambda=[-0.2, 0.1]",
                                     "perimeter.discriminator_signal=[0.1, 0.2]"}),
                    "discriminator_signal is 0.1 at discriminator_detuning_lambda -0.2; allowed is the same sign");
    expect_contains(check_complaint({"perimeter.discriminator_detuning_lambda=[-0.2, -0.1]",
                                     "perimeter.discriminator_signal=[-0.2, -0.1]"}),
                    "2 points below 0 and none above");
    expect_contains(set_complaint("perimeter.discriminator_centre_lambda=0.3"), "-0.2..0.2");
}

TEST(Schema, FaultsAreListsOfEqualLength) {
    const Config c = from_toml(
        "[faults]\nkind = [\"laser_off\", \"frame_late\"]\nat_s = [1, 2.5]\nduration_s = [0.1, 0]\nsize = [0, 0]\n");
    EXPECT_NO_THROW(check(c));
    EXPECT_EQ(c.faults.kind, (std::vector<FaultKind>{FaultKind::laser_off, FaultKind::frame_late}));
    EXPECT_EQ(c.faults.at_s, (std::vector<double>{1.0, 2.5}));
    EXPECT_NO_THROW(check(with({"faults.kind=shock", "faults.at_s=1", "faults.duration_s=0.011", "faults.size=-0.2"})));
    expect_contains(check_complaint({"faults.kind=[\"shock\", \"shock\"]", "faults.at_s=1"}),
                    "faults.kind: 2, faults.at_s: 1, faults.duration_s: 0, faults.size: 0; allowed is as many of each");
    expect_contains(set_complaint("faults.kind=[\"shock\", \"quake\"]"), "faults.kind = 'quake': allowed is one or an");
    expect_contains(set_complaint("faults.kind=[1]"), "a string is wanted, this is an integer");
    expect_contains(set_complaint("faults.at_s=[1, -1]"), "faults.at_s = [1, -1]: allowed is");
    expect_contains(set_complaint("faults.random_per_hour=-1"), "allowed is 0..1e6");
    EXPECT_EQ(with({"faults.kind=[]"}).faults.kind.size(), 0u);
}

TEST(Schema, EdgesAreShiftedOnlyInAGyroThatObeys) {
    expect_contains(check_complaint({"gyro.dither=auto"}), "gyro.dither = \"auto\": the averaged gyro");
    EXPECT_NO_THROW(check(with({"gyro.dither=auto", "gyro.fidelity=laser"})));
    // A log of a real gyro says nothing of fidelity.
    EXPECT_NO_THROW(check_compensation(with({"gyro.dither=auto"})));
}

}  // namespace zlg::config::schema_rules_test
