#include <zlg/wire/parameters.hpp>

#include "test.hpp"

namespace zlg::wire::parameters_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

TEST(Parameters, EachHasAPlaceANameAndAKeyOfItsOwn) {
    const GyroSettings settings;
    std::set<std::string_view> names;
    int before = 0;
    for (const ParameterInfo& info : parameters()) {
        EXPECT_GT(info.key, before);
        before = info.key;
        EXPECT_TRUE(std::isfinite(parameter(settings, info.key))) << info.key;
        EXPECT_TRUE(names.insert(parameter_name(info.key)).second) << info.key;
        EXPECT_FALSE(parameter_name(info.key).empty()) << info.key;
    }
}

TEST(Parameters, AnUnknownKeyIsNothing) {
    GyroSettings settings;
    EXPECT_TRUE(std::isnan(parameter(settings, 0)));
    EXPECT_TRUE(std::isnan(parameter(settings, 0xFFFF)));
    EXPECT_EQ(put_parameter(settings, 0xFFFF, 1.0), CommandResult::unknown_key);
    EXPECT_TRUE(parameter_name(0xFFFF).empty());
}

TEST(Parameters, WhatIsPutIsReadAndNothingElseChanges) {
    for (const ParameterInfo& info : parameters()) {
        if (info.access == ParameterAccess::read_only) continue;
        GyroSettings settings;
        const double value = parameter(settings, info.key) == 1.0 ? 0.0 : 1.0;
        ASSERT_EQ(put_parameter(settings, info.key, value), CommandResult::done) << parameter_name(info.key);
        EXPECT_EQ(parameter(settings, info.key), value) << parameter_name(info.key);
        for (const ParameterInfo& other : parameters()) {
            if (other.key == info.key) continue;
            EXPECT_EQ(parameter(settings, other.key), parameter(GyroSettings{}, other.key))
                << parameter_name(info.key) << " changed " << parameter_name(other.key);
        }
    }
}

TEST(Parameters, AreWhereTheirNamesSay) {
    GyroSettings s;
    (void)put_parameter(s, 0x0402, 1234.0);
    EXPECT_EQ(s.control.schedule.interval_ticks, 1234);
    (void)put_parameter(s, 0x0506, 0.031);
    EXPECT_EQ(s.control.mode_switch.lock_tolerance.value(), 0.031);
    (void)put_parameter(s, 0x1005, 61e3);
    EXPECT_EQ(s.compensation.gyro.bias.value(), 61e3);
}

TEST(Parameters, WhatMustAgreeIsPutTogether) {
    GyroSettings s;
    (void)put_parameter(s, 0x0204, 12.5);
    EXPECT_EQ(s.control.loop.range.margin.value(), 12.5);
    EXPECT_EQ(s.control.mode_switch.range, s.control.loop.range);
    EXPECT_EQ(s.control.half_wave.range, s.control.loop.range);
    (void)put_parameter(s, 0x1004, 1.25);
    EXPECT_EQ(s.compensation.gyro.scale.value(), 1.25);
    EXPECT_EQ(s.control.commutator.dither.scale_arcsec, 1.25);
}

// Every module of the compensation reads these constants in one place.
TEST(Parameters, ConstantsOfTheGyroHaveOnePlace) {
    GyroSettings s;
    (void)put_parameter(s, 0x1009, 0.0125);
    EXPECT_EQ(s.compensation.gyro.light_noise.value(), 0.0125);
    (void)put_parameter(s, 0x1201, 0.25);
    EXPECT_EQ(s.compensation.gyro.random_walk.value(), 0.25);
}

TEST(Parameters, WhatCannotBeTheValueIsRefusedAndNothingChanges) {
    for (const ParameterInfo& info : parameters()) {
        GyroSettings s;
        const double before = parameter(s, info.key);
        for (const double value : {nan, inf, -inf}) {
            EXPECT_NE(put_parameter(s, info.key, value), CommandResult::done) << parameter_name(info.key);
            EXPECT_EQ(parameter(s, info.key), before);
        }
        if (info.access == ParameterAccess::read_only)
            EXPECT_EQ(put_parameter(s, info.key, before), CommandResult::read_only);
    }
    GyroSettings s;
    EXPECT_EQ(put_parameter(s, 0x0402, 1.5), CommandResult::not_a_value);
    EXPECT_EQ(put_parameter(s, 0x0402, 0x1p54), CommandResult::not_a_value);
    EXPECT_EQ(put_parameter(s, 0x0501, 0x1p31), CommandResult::not_a_value);
    EXPECT_EQ(put_parameter(s, 0x0501, -0x1p31), CommandResult::not_a_value);
    EXPECT_EQ(put_parameter(s, 0x0602, -1.0), CommandResult::not_a_value);
}

TEST(SettingsCrc, TellsSettingsApart) {
    GyroSettings a;
    GyroSettings b;
    EXPECT_EQ(settings_crc(a), settings_crc(b));
    for (const ParameterInfo& info : parameters()) {
        if (info.access == ParameterAccess::read_only) continue;
        b = a;
        (void)put_parameter(b, info.key, parameter(b, info.key) == 1.0 ? 0.0 : 1.0);
        EXPECT_NE(settings_crc(a), settings_crc(b)) << parameter_name(info.key);
    }
}

// The description lists every key with its name.
TEST(Parameters, StandInTheDescription) {
    const std::string shared{ZLG_SHARED_DIR};
    std::ifstream file{shared.substr(0, shared.rfind("/../")) + "/docs/wire.md"};
    ASSERT_TRUE(file);
    const std::string text{std::istreambuf_iterator<char>{file}, {}};
    for (const ParameterInfo& info : parameters()) {
        std::array<char, 8> key{};
        (void)std::snprintf(key.data(), key.size(), "0x%04X", info.key);
        const std::string access = info.access == ParameterAccess::read_only ? "read" : "read, set";
        const std::string row =
            "| " + std::string{key.data()} + " | `" + std::string{parameter_name(info.key)} + "` | " + access + " |";
        EXPECT_NE(text.find(row), std::string::npos) << row;
    }
}

}  // namespace zlg::wire::parameters_test
