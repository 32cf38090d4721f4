#include <zlg/firmware/stored.hpp>

#include <cstring>

#include <rapidcheck/gtest.h>

#include <zlg/firmware/exchange.hpp>
#include <zlg/wire/crc.hpp>

#include "test.hpp"

namespace zlg::stored_test {

using namespace firmware;

struct Bytes {
    alignas(Settings) std::array<std::uint8_t, stored_bytes> bytes{};

    explicit Bytes(const Settings& settings) { put_stored(settings, bytes); }
    void put_crc() {
        const std::uint32_t crc = wire::crc32c(std::span{bytes}.first(stored_bytes - 4));
        std::memcpy(&bytes[stored_bytes - 4], &crc, 4);
    }
};

Settings of_a_gyro() {
    Settings settings;
    settings.control.commutator.half_ticks = 20'000;
    settings.compensation.gyro.tick = core::Seconds{0.004};
    return settings;
}

TEST(Stored, are_the_settings_of_this_program) {
    const Bytes stored{of_a_gyro()};
    EXPECT_EQ(fault_of(stored.bytes), StoredFault::none);
    EXPECT_EQ(layout_in(stored.bytes), layout());
    EXPECT_EQ(settings_in(stored.bytes).control.commutator.half_ticks, 20'000u);
    EXPECT_EQ(settings_in(stored.bytes).compensation.gyro.tick, core::Seconds{0.004});
}

TEST(Stored, have_a_number_of_their_own) {
    const Bytes stored{of_a_gyro()};
    const Bytes others{Settings{}};
    EXPECT_EQ(settings_crc(settings_in(stored.bytes)),
              wire::crc32c(std::span{stored.bytes}.subspan(16, sizeof(Settings))));
    EXPECT_NE(settings_crc(settings_in(stored.bytes)), settings_crc(settings_in(others.bytes)));
}

#if __has_builtin(__builtin_clear_padding)
// Whatever lay where the settings were made. Clang 14 knows no way to clear padding: what it builds loads into a gyro
// as well, but two files of the same settings may differ in bytes that nobody reads.
TEST(Stored, are_the_same_bytes_for_the_same_settings) {
    alignas(Settings) std::array<std::byte, sizeof(Settings)> other{};
    other.fill(std::byte{0xa5});
    const auto* const settings = ::new (&other) Settings{of_a_gyro()};
    EXPECT_EQ(Bytes{*settings}.bytes, Bytes{of_a_gyro()}.bytes);
}
#endif

RC_GTEST_PROP(Stored, are_refused_with_any_bit_changed, ()) {
    Bytes stored{of_a_gyro()};
    const auto bit = *rc::gen::inRange<std::size_t>(0, 8 * stored_bytes);
    stored.bytes[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
    RC_ASSERT(fault_of(stored.bytes) == (bit < 64 ? StoredFault::other_kind : StoredFault::damaged));
}

RC_GTEST_PROP(Stored, are_refused_when_cut, ()) {
    const Bytes stored{of_a_gyro()};
    const auto n = *rc::gen::inRange<std::size_t>(0, stored_bytes);
    RC_ASSERT(fault_of(std::span{stored.bytes}.first(n)) == (n < 8 ? StoredFault::other_kind : StoredFault::damaged));
}

TEST(Stored, of_another_program_are_named_as_such) {
    Bytes stored{of_a_gyro()};
    stored.bytes[12] ^= 1;
    stored.put_crc();
    EXPECT_EQ(fault_of(stored.bytes), StoredFault::other_program);
}

TEST(Stored, are_refused_where_the_core_refuses_them) {
    Settings settings = of_a_gyro();
    settings.compensation.gyro.random_walk = core::ArcsecPerRootSecond{-1.0};
    EXPECT_EQ(fault_of(Bytes{settings}.bytes), StoredFault::refused);
}

}  // namespace zlg::stored_test
