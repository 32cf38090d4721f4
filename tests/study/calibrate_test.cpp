#include <zlg/study/calibrate.hpp>

#include <zlg/calibration/lab_reader.hpp>
#include <zlg/config/schema.hpp>
#include <zlg/logs/error.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

#include "test.hpp"

namespace zlg::calibrate_test {

config::Config bench(std::uint64_t seed) {
    config::Config c;
    for (const char* setting : {"motion.kind=rest", "switching.interval_s=2", "gyro.light_samples=8",
                                "gyro.dither=none", "gyro.tick_s=0.005", "gyro.scale_arcsec=3.263"})
        config::apply_set(c, setting);
    c.run.seed = seed;
    return c;
}

struct Log {
    logs::RawHeader header;
    std::vector<core::HalfRecord> halves;
};

Log log_of(const config::Config& c, double duration_s) {
    rig::ClosedLoop loop{c, rig::motion(c)};
    Log log;
    static_cast<logs::RawColumns&>(log.header) = logs::all_raw_columns;
    log.header.settings = config::to_settings(c);
    for (int h = 0; h < static_cast<int>(2.0 * duration_s / c.gyro.tick_s); ++h)
        log.halves.push_back(loop.advance().record);
    return log;
}

// Logs in memory, named in the order of the alphabet.
struct Lab {
    std::map<std::string, Log> logs;

    [[nodiscard]] study::CalibrationTask task() const {
        study::CalibrationTask task;
        for (const auto& [name, log] : logs) task.logs.push_back(name);
        task.open = [this](const std::string& name) {
            const Log& log = logs.at(name);
            return logs::RawReader{name, log.header, log.halves};
        };
        return task;
    }
};

const Lab& two_logs() {
    static const Lab lab{{{"a", log_of(bench(1), 150.0)}, {"b", log_of(bench(2), 150.0)}}};
    return lab;
}

std::string refusal(const study::CalibrationTask& task) {
    try {
        (void)study::calibrate(task);
    } catch (const config::ConfigError& error) {
        return std::string{"configuration: "} + error.what();
    } catch (const logs::FormatError& error) {
        return std::string{"log: "} + error.what();
    }
    return "none";
}

TEST(Calibrate, finds_what_the_laws_find_in_the_same_logs) {
    std::vector<calibration::LabLog> logs;
    for (const auto& [name, log] : two_logs().logs) {
        calibration::LabReader reader{name, 0.005};
        for (const core::HalfRecord& half : log.halves) reader.take(half);
        logs.push_back(reader.finish());
    }
    const calibration::Calibration expected = calibration::calibrate(logs, {.rate_arcsec_s = 2.0});
    study::CalibrationTask task = two_logs().task();
    task.rate_arcsec_s = 2.0;
    const study::CalibrationResult result = study::calibrate(task);
    ASSERT_EQ(result.calibration.constants.size(), expected.constants.size());
    for (std::size_t k = 0; k < expected.constants.size(); ++k) {
        EXPECT_EQ(result.calibration.constants[k].key, expected.constants[k].key);
        EXPECT_EQ(result.calibration.constants[k].estimate.value, expected.constants[k].estimate.value);
        EXPECT_EQ(result.calibration.constants[k].estimate.sigma, expected.constants[k].estimate.sigma);
    }
    EXPECT_TRUE(result.any_determined());
    ASSERT_EQ(result.logs.size(), 2u);
    EXPECT_EQ(result.logs[1].path, "b");
    EXPECT_DOUBLE_EQ(result.logs[1].duration_s, 150.0);
}

TEST(Calibrate, writes_a_configuration_that_holds_what_was_determined) {
    const study::CalibrationResult result = study::calibrate(two_logs().task());
    config::Config read;
    config::apply_toml(read, study::calibration_toml(result), "calibration");
    for (const calibration::Constant& c : result.calibration.constants) {
        EXPECT_EQ(config::is_given(read, c.key), c.estimate.determined) << c.key;
        if (c.key == "gyro.bias_hz") EXPECT_NEAR(read.gyro.bias_hz, c.estimate.value, 1e-9 * c.estimate.value);
    }
    EXPECT_EQ(read.gyro.tick_s, 0.005);
}

TEST(Calibrate, refuses_a_rate_that_no_gyro_has) {
    study::CalibrationTask task = two_logs().task();
    task.rate_arcsec_s = 2e9;
    EXPECT_EQ(refusal(task), "configuration: rate_arcsec_s 2000000000: allowed is -1e9..1e9, more than any gyro turns");
}

TEST(Calibrate, refuses_logs_that_do_not_go_together) {
    const auto with = [](const char* setting) {
        config::Config c = bench(1);
        config::apply_set(c, setting);
        return Lab{{{"a", log_of(bench(1), 1.0)}, {"b", log_of(c, 1.0)}}};
    };
    const Lab tick = with("gyro.tick_s=0.01"), scale = with("gyro.scale_arcsec=3"),
              temperature = with("gyro.reference_temperature_c=40"), loop = with("perimeter.loop=digital");
    EXPECT_EQ(refusal(tick.task()), "log: gyro.tick_s = 0.005 in a, 0.01 in b; allowed is one value");
    EXPECT_EQ(refusal(scale.task()), "log: gyro.scale_arcsec = 3.263 in a, 3 in b; allowed is one value");
    EXPECT_NE(refusal(temperature.task()).find("gyro.reference_temperature_c = 20 in a, 40 in b"), std::string::npos);
    EXPECT_EQ(refusal(loop.task()), "configuration: perimeter.loop differs between a and b; calibrate them apart");
    // What the user says stands above both.
    study::CalibrationTask said = temperature.task();
    config::apply_set(said.said, "gyro.reference_temperature_c=30");
    EXPECT_EQ(study::calibrate(said).config.gyro.reference_temperature_c, 30.0);
}

TEST(Calibrate, says_which_field_tells_nothing) {
    Lab lab{{{"a", log_of(bench(1), 1.0)}}};
    study::CalibrationTask said = lab.task();
    const auto why = [&said] {
        for (const calibration::Constant& c : study::calibrate(said).calibration.constants)
            if (c.key == "field.sensitivity_arcsec_s_g") return c.estimate.reason;
        return std::string{};
    };
    EXPECT_EQ(why(), "the field of a log is not known");
    config::apply_set(said.said, "field.kind=sine");
    config::apply_set(said.said, "field.frequency_hz=2.5");
    EXPECT_EQ(why(), "field.frequency_hz = 2.5 tells nothing: allowed is up to 1 Hz");
    config::apply_set(said.said, "field.frequency_hz=1");
    EXPECT_NE(why().find("pieces of settled record"), std::string::npos) << why();
}

TEST(Calibrate, refuses_a_log_without_a_tick_or_whose_facts_nobody_says) {
    Lab lab{{{"a", log_of(bench(1), 1.0)}}};
    Log& log = lab.logs.at("a");
    log.halves.resize(1);
    EXPECT_EQ(refusal(lab.task()), "log: a: holds no whole tick, which is two half-periods");
    log.header.settings.clear();
    EXPECT_NE(refusal(lab.task()).find("configuration: a: "), std::string::npos);
}

}  // namespace zlg::calibrate_test
