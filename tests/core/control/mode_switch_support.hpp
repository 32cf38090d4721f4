#pragma once
// Feeds the sequencer of a switch half by half, on the clock of the ticks.

#include <gtest/gtest.h>

#include <cstdint>
#include <zlg/core/common/maths.hpp>
#include <zlg/core/control/mode_switch.hpp>

namespace zlg::core::test {

inline constexpr ModeSwitchConfig config{.gap_ticks = 3, .settle_ticks = 4, .lock_timeout_ticks = 12, .dark_ticks = 2};

enum class Seen { locked, detuned, dark, missed };

class Sequence {
public:
    ModeSwitchOutput half(Seen seen, bool due = false) {
        ModeSwitchInput in;
        in.tick_border = half_ % 2 == 1;
        in.next_tick = (half_ + 1) / 2;
        in.due = due;
        in.light_known = seen != Seen::missed;
        in.two_way = seen == Seen::locked || seen == Seen::detuned;
        in.usable = in.two_way;
        in.detuning = Wavelengths{seen == Seen::locked ? 0.001 : 0.2};
        in.piezo = Volts{seen == Seen::missed ? not_a_number : piezo_v};
        in.set_point = Volts{set_point_v};
        in.half_wave = Volts{40.0};
        in.offset = Volts{offset_v};
        ++half_;
        last_ = step(config, state, in);
        if (last_.event) {
            event = *last_.event;
            ++n_events;
        }
        return last_;
    }

    void halves(int n, Seen seen) {
        for (int k = 0; k < n; ++k) (void)half(seen);
    }

    // To the state of the name, by the shortest way, ending before the first half of a tick.
    void to_tracking() {
        halves(8, Seen::locked);
        ASSERT_EQ(state.phase, SwitchPhase::tracking);
    }
    void to_open() {
        to_tracking();
        (void)half(Seen::locked);
        (void)half(Seen::locked, true);
        ASSERT_EQ(state.phase, SwitchPhase::open);
    }
    void to_settling() {
        to_open();
        halves(6, Seen::dark);
        ASSERT_EQ(state.phase, SwitchPhase::settling);
    }
    void to_returning() {
        to_settling();
        halves(4, Seen::dark);
        ASSERT_EQ(state.phase, SwitchPhase::returning);
    }
    void to_searching() {
        to_returning();
        halves(6 + 4, Seen::dark);
        ASSERT_EQ(state.phase, SwitchPhase::searching);
    }

    double offset_v = 0.0;
    ModeSwitchState state = initial_state(config);
    SwitchEvent event;
    int n_events = 0;
    double piezo_v = 160.0;
    double set_point_v = 150.0;

private:
    std::int64_t half_ = 0;
    ModeSwitchOutput last_;
};

}  // namespace zlg::core::test
