// Claims about descriptions: what is read is what is written, and what contradicts itself is refused with its place.

#include <zlg/sweep/description.hpp>

#include "descriptions.hpp"

namespace zlg::sweep::description_test {

std::string refusal(const std::string& toml) {
    return test::refusal_by<config::ConfigError>([&] { (void)parse(toml, "s.toml"); });
}

std::string refusal_of_parameter(const std::string& parameter) {
    return refusal("[sweep]\ngyros = 4\n[[parameter]]\n" + parameter + testing_metric);
}

TEST(Description, what_is_written_reads_back) {
    const Description d = parse(every_draw, "s.toml");
    EXPECT_EQ(d.parameters.size(), 8u);
    EXPECT_EQ(d, parse(to_toml(d), "again"));
    EXPECT_EQ(to_toml(d), to_toml(parse(to_toml(d), "again")));
}

TEST(Description, checksums_of_motion_files_read_back_and_decide) {
    Description d = parse(every_draw, "s.toml");
    d.motion_checksums = {{"a \"b\".csv", "0123456789abcdef"}, {"c.csv", "fedcba9876543210"}};
    EXPECT_EQ(d, parse(to_toml(d), "again"));
    Description other = d;
    other.motion_checksums["c.csv"] = "0000000000000000";
    EXPECT_EQ(difference(to_toml(d), to_toml(d)), "");
    EXPECT_EQ(difference(to_toml(d), to_toml(other)),
              "has `\"c.csv\" = \"fedcba9876543210\"`, this one `\"c.csv\" = \"0000000000000000\"`");
    EXPECT_NE(refusal("[motion_checksums]\n\"a\" = 1\n[sweep]\ngyros = 4\n" + std::string{testing_metric}), "");
}

TEST(Description, of_a_grid_the_number_of_gyros_follows) {
    const std::string grid =
        "[[parameter]]\nkeys = [\"piezo.half_wave_v\"]\ndraw = \"grid\"\nmin = 30\nmax = 50\nn = 3\n"
        "[[parameter]]\nkeys = [\"compensation.relock\"]\ndraw = \"grid\"\nvalues = [\"none\", \"detuning\"]\n";
    const Description d = parse("[sweep]\n" + grid + testing_metric, "s.toml");
    EXPECT_EQ(d.n_gyros, 6);
    EXPECT_EQ(d.parameters[0].values, (std::vector<Value>{30.0, 40.0, 50.0}));
    EXPECT_EQ(parse("[sweep]\ngyros = 12\n" + grid + testing_metric, "s.toml").n_gyros, 12);
    EXPECT_EQ(refusal("[sweep]\ngyros = 7\n" + grid + testing_metric),
              "s.toml:2: [sweep] gyros = 7: allowed is a multiple of the 6 points of the grid, or nothing");
}

TEST(Description, the_base_reaches_the_configuration) {
    const Description d =
        parse("[sweep]\ngyros = 1\nduration_s = 12\n[base.gyro]\ntick_s = 0.01\n" + testing_metric, "s");
    EXPECT_EQ(base_config(d).gyro.tick_s, 0.01);
    EXPECT_EQ(base_config(d).run.duration_s, 12.0);
}

TEST(Description, refuses_what_contradicts_itself_and_says_where) {
    const std::string key = "keys = [\"piezo.half_wave_v\"]\n";
    EXPECT_EQ(refusal_of_parameter(key + "draw = \"uniform\"\nmin = 5\nmax = 5\n"),
              "s.toml:7: [parameter] max = 5: allowed is a number above min = 5");
    EXPECT_EQ(refusal_of_parameter(key + "draw = \"uniform\"\nmin = 5\nmean = 6\nmax = 7\n"),
              "s.toml:7: unknown key [parameter] mean; allowed are keys, draw, min, max");
    EXPECT_EQ(refusal_of_parameter(key + "draw = \"normal\"\nmean = 5\n"), "s.toml:3: [parameter] sd is missing");
    EXPECT_EQ(refusal_of_parameter(key + "draw = \"normal\"\nmean = nan\nsd = 1\n"),
              "s.toml:6: [parameter] mean = nan: allowed is a finite number");
    EXPECT_EQ(refusal_of_parameter(key + "draw = \"log_uniform\"\nmin = 0\nmax = 1\n"),
              "s.toml:6: [parameter] min = 0: allowed is a number above 0 for log_uniform");
    EXPECT_EQ(
        refusal_of_parameter(key + "draw = \"truncated\"\nmean = 40\nsd = 1\nmin = 50\nmax = 60\n"),
        "s.toml:6: [parameter] mean = 40: allowed is one that leaves at least 0.001 of the law within min and max");
    EXPECT_EQ(refusal_of_parameter(key + "draw = \"gamma\"\n"),
              "s.toml:5: [parameter] draw = \"gamma\": allowed is one of grid, list, uniform, log_uniform, normal, "
              "truncated, latin, sobol");
    EXPECT_EQ(refusal_of_parameter(key + "draw = \"list\"\nvalues = []\n"),
              "s.toml:6: [parameter] values = []: allowed is an array of one value at least");
}

TEST(Description, of_a_former_version_is_read_and_its_design_of_rows_is_refused) {
    const std::string rest = "\ngyros = 3\n" + testing_metric;
    EXPECT_EQ(parse("[sweep]\nsensitivity = false" + rest, "s").n_gyros, 3);
    EXPECT_THROW((void)parse("[sweep]\nsensitivity = true" + rest, "s"), config::ConfigError);
}

TEST(Description, refuses_what_a_key_does_not_take_before_any_gyro_runs) {
    EXPECT_NE(refusal_of_parameter("keys = [\"piezo.half_wave\"]\ndraw = \"uniform\"\nmin = 1\nmax = 2\n")
                  .find("did you mean half_wave_v?"),
              std::string::npos);
    EXPECT_NE(refusal_of_parameter("keys = [\"gyro.tick_s\"]\ndraw = \"uniform\"\nmin = 0.001\nmax = 20\n")
                  .find("gyro.tick_s = 20: allowed is"),
              std::string::npos);
    EXPECT_NE(refusal_of_parameter("keys = [\"compensation.relock_ticks\"]\ndraw = \"uniform\"\nmin = 1\nmax = 5\n")
                  .find("takes integers"),
              std::string::npos);
    EXPECT_NE(refusal_of_parameter("keys = [\"run.seed\"]\ndraw = \"list\"\nvalues = [1]\n").find("sweep.seed"),
              std::string::npos);
    const std::string twice = "keys = [\"gyro.bias_chi\", \"gyro.bias_chi\"]\ndraw = \"list\"\nvalues = [3.6]\n";
    EXPECT_NE(refusal_of_parameter(twice).find("gyro.bias_chi is driven twice"), std::string::npos);
}

TEST(Description, refuses_a_sweep_of_nothing_and_of_too_much) {
    EXPECT_EQ(refusal("[sweep]\ngyros = 0\n" + testing_metric),
              "s.toml:2: [sweep] gyros = 0: allowed is an integer 1..10000000");
    EXPECT_EQ(refusal("[sweep]\ngyros = 1000000000000\n" + testing_metric),
              "s.toml:2: [sweep] gyros = 1000000000000: allowed is an integer 1..10000000");
    EXPECT_NE(refusal("[sweep]\ngyros = 3\n").find("no [[metric]]"), std::string::npos);
    EXPECT_NE(refusal("[sweep]\ngyros = 3\n[[metric]]\nname = \"configured.switch_error_rms\"\n")
                  .find("did you mean configured.switch_error_rms_arcsec?"),
              std::string::npos);
    EXPECT_NE(refusal("[sweep\n").find("s.toml:1:"), std::string::npos);
}

TEST(Description, an_integer_keeps_every_digit) {
    const std::string largest = "9223372036854775807";
    const Description d = parse("[sweep]\n[[parameter]]\nkeys = [\"faults.random_seed\"]\ndraw = \"grid\"\nvalues = [" +
                                    largest + ", 9007199254740993, 9007199254740992, 1]\n" + testing_metric,
                                "s.toml");
    const std::vector<Value>& values = d.parameters[0].values;
    EXPECT_EQ(toml_of(values[0]), largest);
    EXPECT_EQ(toml_of(values[1]), "9007199254740993");
    EXPECT_EQ(values[2], Value{9007199254740992.0});
    EXPECT_EQ(d, parse(to_toml(d), "again"));
    // A limit is a real number, which an integer is rounded to.
    EXPECT_EQ(*parse("[sweep]\ngyros = 1\n" + testing_metric + "max = 9007199254740993\n", "s").metrics[0].max, 0x1p53);
}

TEST(Description, refuses_ranges_that_no_number_is_as_wide_as) {
    const std::string key = "keys = [\"drift.magnetic_arcsec_s\"]\n";
    for (const char* draw : {"uniform", "latin", "sobol"})
        EXPECT_NE(refusal_of_parameter(key + "draw = \"" + draw + "\"\nmin = -1e308\nmax = 1e308\n")
                      .find("max = 1e+308: allowed is"),
                  std::string::npos)
            << draw;
    EXPECT_NE(refusal_of_parameter(key + "draw = \"grid\"\nmin = -1e308\nmax = 1e308\nn = 3\n")
                  .find("max = 1e+308: allowed is"),
              std::string::npos);
    EXPECT_NE(
        refusal_of_parameter(key + "draw = \"normal\"\nmean = 1e308\nsd = 1e307\n").find("sd = 1e+307: allowed is"),
        std::string::npos);
    EXPECT_NE(refusal_of_parameter("keys = [\"motion.rate_hz\"]\ndraw = \"log_uniform\"\nmin = 1e-300\nmax = 1e300\n")
                  .find("max = 1e+300: allowed is"),
              std::string::npos);
}

TEST(Description, a_grid_is_counted_before_its_values_are_tried) {
    std::string grid = "[sweep]\n";
    for (const char* key : {"gyro.bias_chi", "piezo.half_wave_v"})
        grid +=
            std::string{"[[parameter]]\nkeys = [\""} + key + "\"]\ndraw = \"grid\"\nmin = 3.4\nmax = 3.8\nn = 4000\n";
    EXPECT_EQ(refusal(grid + testing_metric),
              "s.toml:8: [parameter] the grid has more than 10000000 points with this parameter; allowed is that many");
}

TEST(Description, says_what_a_number_must_be_written_like) {
    EXPECT_EQ(refusal("[sweep]\ngyros = 1e1\n" + testing_metric),
              "s.toml:2: [sweep] gyros = 10: allowed is an integer 1..10000000, written without a point and without an "
              "exponent");
    EXPECT_EQ(refusal("[sweep]\ngyros = 1\nduration_s = -1\n" + testing_metric).substr(0, 31),
              "s.toml:3: [sweep] duration_s: r");
    EXPECT_NE(refusal("[sweep]\ngyros = 3\n[[metric]]\nname = \"configured.foo\"\n").find("did you mean configured."),
              std::string::npos);
}

TEST(Description, two_sweeps_go_together_but_for_limits_and_more_gyros) {
    const std::string head = "[sweep]\nseed = 3\ngyros = ";
    const std::string ours = to_toml(parse(head + "4\n" + testing_metric, "s"));
    const std::string more = to_toml(parse(head + "9\n" + testing_metric + "max = 2\n", "s"));
    EXPECT_EQ(difference(ours, more), "");
    EXPECT_NE(first_difference(ours, more), "");
    const std::string other = to_toml(parse("[sweep]\nseed = 4\ngyros = 4\n" + testing_metric, "s"));
    EXPECT_EQ(difference(other, ours), "has `seed = 4`, this one `seed = 3`");
    const std::string two = to_toml(parse(head + "4\n" + testing_metric + "[[metric]]\nname = \"switches\"\n", "s"));
    EXPECT_EQ(difference(ours, two), "has nothing more, this one `[[metric]] name = \"switches\"`");
}

TEST(Description, a_grid_and_a_latin_hypercube_do_not_grow) {
    EXPECT_FALSE(may_grow(parse(every_draw, "s")));
    const auto of = [](const std::string& n) {
        return to_toml(parse("[sweep]\ngyros = " + n +
                                 "\n[[parameter]]\nkeys = [\"gyro.bias_chi\"]\ndraw = \"latin\"\nmin = 3\nmax = 4\n" +
                                 testing_metric,
                             "s"));
    };
    EXPECT_EQ(difference(of("4"), of("5")), "has `gyros = 4`, this one `gyros = 5`");
}

}  // namespace zlg::sweep::description_test
