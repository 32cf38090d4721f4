// Claims about the gyros of a sweep: each is the run that it names, and one that fails is a row with its reason.

#include <zlg/study/run.hpp>
#include <zlg/sweep/gyros.hpp>

#include "descriptions.hpp"

namespace zlg::sweep::gyros_test {

Description with(const std::string& parameter, const std::string& duration_s = "5") {
    return parse("[sweep]\ngyros = 2\nduration_s = " + duration_s + "\n[base.switching]\ninterval_s = 2\n" + parameter +
                     testing_metric,
                 "s");
}

TEST(Gyros, a_row_has_the_bits_of_the_whole_run) {
    const Gyros gyros{parse(every_draw, "s")};
    for (const std::int64_t k : {0, 5}) {
        const Row row = gyros.run(k);
        study::RunTask task;
        task.config = gyros.config(k);
        const study::RunResult whole = study::run(task);
        ASSERT_EQ(row.status, Status::good) << row.reason;
        EXPECT_EQ(row.fingerprint, whole.fingerprint);
        EXPECT_EQ(row.metrics[0], whole.variants.back().switch_error->rms_arcsec);
        EXPECT_EQ(row.metrics[1], whole.variant("one_mode")->drift_arcsec_s);
        EXPECT_EQ(row.metrics[2], static_cast<double>(whole.switches.size()));
    }
}

TEST(Gyros, all_keys_of_a_parameter_take_its_value) {
    const Gyros gyros{parse(every_draw, "s")};
    const config::Config config = gyros.config(3);
    EXPECT_EQ(config.drift.magnetic_arcsec_s, config.compensation.magnetic_arcsec_s);
    EXPECT_NE(config.drift.magnetic_arcsec_s, 0.7);
    EXPECT_EQ(config.run.seed, static_cast<std::uint64_t>(gyros.seed(3)));
}

TEST(Gyros, values_that_make_no_gyro_are_a_refused_row) {
    // Far out on the law the light noise is negative.
    const Gyros gyros{
        with("[[parameter]]\nkeys = [\"gyro.light_noise_lambda\"]\ndraw = \"normal\"\nmean = 1e-9\nsd = 1e6\n")};
    for (const std::int64_t k : {0, 1}) {
        const Row row = gyros.run(k);
        EXPECT_EQ(row.status, Status::refused);
        EXPECT_NE(row.reason.find("gyro.light_noise_lambda"), std::string::npos) << row.reason;
        EXPECT_EQ(row.fingerprint, "");
        EXPECT_TRUE(std::isnan(row.metrics[0]));
    }
}

TEST(Gyros, a_run_without_a_switch_has_no_error_of_one) {
    const Row row = Gyros{with("", "1")}.run(0);
    EXPECT_EQ(row.status, Status::no_switch);
    EXPECT_EQ(row.reason, "configured.switch_error_rms_arcsec: the run has no switch");
    EXPECT_EQ(row.fingerprint.size(), 16u);
}

TEST(Gyros, a_gyro_that_loses_every_switch_is_lost) {
    // Half a wavelength takes far more than is presumed.
    const Row row =
        Gyros{parse("[sweep]\ngyros = 1\nduration_s = 6\n[base.switching]\ninterval_s = 1\n[base.perimeter]\n"
                    "miss_lambda = 0\n[base.piezo]\nhalf_wave_error = -0.5\n" +
                        testing_metric,
                    "s")}
            .run(0);
    EXPECT_EQ(row.status, Status::lost) << row.reason;
    EXPECT_NE(row.reason, "");
}

TEST(Gyros, stops_when_asked) {
    EXPECT_THROW((void)Gyros{short_sweep()}.run(0, [] { return true; }), Stopped);
}

TEST(Gyros, the_command_names_all_that_differs_from_the_defaults) {
    const Gyros gyros{parse(every_draw, "s")};
    const std::string line = gyros.command(1);
    EXPECT_EQ(line.find("zlg run --seed " + std::to_string(gyros.seed(1)) + " --duration 6 --set "), 0u) << line;
    for (const char* key :
         {"--set switching.interval_s=2", "--set 'compensation.relock=\"mean_square\"'", "--set gyro.light_samples=16",
          "--set 'compensation.bridge=\"auto\"'", "--set compensation.magnetic_arcsec_s="})
        EXPECT_NE(line.find(key), std::string::npos) << key << " in " << line;
}

TEST(Gyros, the_command_names_no_key_twice) {
    const Gyros gyros{
        parse("[sweep]\ngyros = 1\n[base.gyro]\nbias_chi = 3.5\ntick_s = 1e-2\n[[parameter]]\n"
              "keys = [\"gyro.bias_chi\"]\ndraw = \"list\"\nvalues = [3.25]\n" +
                  testing_metric,
              "s")};
    EXPECT_EQ(gyros.command(0),
              "zlg run --seed " + std::to_string(gyros.seed(0)) + " --set gyro.tick_s=0.01 --set gyro.bias_chi=3.25");
    EXPECT_EQ(gyros.config(0).gyro.bias_chi, 3.25);
}

TEST(Gyros, rows_are_equal_bit_for_bit_or_not) {
    const double nan = std::nan("");
    const Row row{.gyro = 1, .fingerprint = "a", .metrics = {0.0, nan}};
    Row other = row;
    EXPECT_TRUE(are_equal(row, other));
    other.metrics[0] = -0.0;
    EXPECT_FALSE(are_equal(row, other));
}

}  // namespace zlg::sweep::gyros_test
