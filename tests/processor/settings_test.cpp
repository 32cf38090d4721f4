// From a configuration to the gyro's flash: what `zlg settings` writes makes the image the gyro that `zlg run` is.

#include <cstdlib>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <zlg/config/schema.hpp>
#include <zlg/processor/qemu.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/fingerprint.hpp>
#include <zlg/rig/wiring.hpp>
#include <zlg/study/resolved.hpp>
#include <zlg/trials/compared.hpp>

#include "built_image.hpp"
#include "temporary_folder.hpp"

namespace zlg::settings_test {

using processor::QemuProcessor;

// Ticks of 2 to 10 ms, loops, readouts, methods, curves: what no parameter of the wire can be set to. Semicolons end
// lines.
constexpr std::array gyros{
    "gyro.tick_s = 0.002; perimeter.loop = 'digital'",
    "gyro.tick_s = 0.0025; gyro.readout = 'phase'; compensation.relock = 'joint'",
    "gyro.tick_s = 0.003; gyro.bias_hz = 240e3; gyro.scale_arcsec = 0.81575; laser.quadrature = 'x4'",
    "gyro.tick_s = 0.004; gyro.bias_chi = 3.1; gyro.bias_chi_higher = [2, -30]; compensation.magnetic = 'estimate'; "
    "compensation.magnetic_arcsec_s = 2; compensation.magnetic_thermal_arcsec_s = -1; "
    "compensation.magnetic_thermal_time_s = 900; drift.magnetic_arcsec_s = 2",
    "gyro.tick_s = 0.005; gyro.fidelity = 'laser'; gyro.dither = 'auto'; compensation.lock_in_hz = 140; "
    "compensation.lock_in_sigma_hz = 20; "
    "motion.amplitude_arcsec_s = 90; run.seed = 12345678901",
    "gyro.tick_s = 0.006; gyro.discriminator_per_lambda = 0.3; perimeter.discriminator_detuning_lambda = [-0.2, -0.1, "
    "0.1, 0.2]; perimeter.discriminator_signal = [-0.055, -0.029, 0.031, 0.058]; perimeter.discriminator_centre_lambda "
    "= 0.01",
    "gyro.tick_s = 0.0075; gyro.light_samples = 64; switching.schedule = 'measured'; switching.interval_min_s = 1; "
    "switching.interval_max_s = 3",
    "gyro.tick_s = 0.008; gyro.readout = 'phase'; perimeter.loop = 'digital'; perimeter.relock_halves = 4; "
    "piezo.hysteresis = 0.12; "
    "piezo.creep_per_decade = 0.015; piezo.half_wave_v = 55; piezo.half_wave_error = 0.02; piezo.range_min_v = -150; "
    "piezo.range_max_v = 150",
    "gyro.tick_s = 0.009; gyro.bias_temperature_coefficient_per_c = 1e-4; gyro.temperature_rise_c = 40; "
    "compensation.bridge = 'quadratic'; compensation.points_before = 4; compensation.points_after = 3; "
    "compensation.relock = 'detuning'; compensation.relock_ticks = 12",
    "gyro.tick_s = 0.01; gyro.first_bias_sign = -1; switching.gap_ticks = 5; switching.gap_min_ticks = 2; "
    "switching.first_segment = 'half'; compensation.relock = 'frequency'; compensation.bridge = 'linear'"};

// Begins with what its flash holds, whatever it is told.
class StoredProcessor final : public rig::Processor {
public:
    explicit StoredProcessor(QemuProcessor& image) : image_{image} {}
    core::ActuatorFrame start(const rig::ProcessorSettings&) override { return image_.start_stored(); }
    rig::ProcessorHalf half(const core::SensorFrame& frame) override { return image_.half(frame); }
    core::DrainOutput drain() override { return image_.drain(); }

private:
    QemuProcessor& image_;
};

class Settings : public testing::TestWithParam<const char*> {
protected:
    [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

    void zlg(const std::string& arguments) const {
        const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "zlg";
        ASSERT_EQ(std::system(fmt::format("{} {}", program.string(), arguments).c_str()), 0);
    }

private:
    test::TemporaryFolder folder_;
};

// Of the image in closed loop with the twin.
std::string fingerprint(const config::Config& config, rig::Processor& processor) {
    rig::ClosedLoop loop{config, rig::motion(config), &processor};
    rig::Fingerprint made;
    const auto take = [&](const core::AngleRow& row) { made.take(row); };
    for (std::int64_t half = 2 * rig::run_ticks(config, rig::motion(config)); half > 0; --half) {
        const rig::LoopHalf out = loop.advance();
        made.take(out, loop.sensor());
        if (out.compensation->has_sample) rig::hand_over(out.compensation->sample, take, rig::ignored);
    }
    rig::hand_over_rest([&] { return processor.drain(); }, take, rig::ignored);
    return made.text();
}

TEST_P(Settings, make_the_image_the_gyro_of_the_configuration) {
    const auto image = test::built_image();
    if (!image) GTEST_SKIP() << "no image of the processor, or no emulator";
    std::string keys = fmt::format("run.duration_s = 6; switching.interval_s = 1.3; {}", GetParam());
    std::replace(keys.begin(), keys.end(), ';', '\n');
    std::ofstream{file("gyro.toml")} << keys << "\n";
    zlg(fmt::format("settings {0}/gyro.toml --out {0}/gyro.bin --json > /dev/null", file(".")));
    zlg(fmt::format("run {0}/gyro.toml --logs none --quiet --json --out {0}/run > {0}/run.json", file(".")));
    const auto summary = nlohmann::json::parse(std::ifstream{file("run.json")});
    ASSERT_GE(summary["switches"].get<int>(), 1);

    config::Config config;
    config::apply_file(config, file("gyro.toml"));
    config = study::resolved(config).config;
    QemuProcessor qemu{{.image = *image, .stored = file("gyro.bin")}};
    StoredProcessor stored{qemu};
    trials::ComparedProcessor both{stored};
    EXPECT_EQ(fingerprint(config, both), summary["fingerprint"].get<std::string>());
    EXPECT_EQ(both.first_difference(), "");
    EXPECT_EQ(qemu.state(), both.state());
}

INSTANTIATE_TEST_SUITE_P(Gyros, Settings, testing::ValuesIn(gyros));

TEST(StoredSettings, are_not_there_in_an_empty_flash) {
    const auto image = test::built_image();
    if (!image) GTEST_SKIP() << "no image of the processor, or no emulator";
    QemuProcessor qemu{{.image = *image}};
    EXPECT_THROW((void)qemu.start_stored(), processor::QemuError);
}

}  // namespace zlg::settings_test
