#pragma once
// Feeds the sequencer of a switch half by half, on the clock of the ticks.

#include <zlg/core/control/mode_switch.hpp>

#include "support.hpp"

namespace zlg::core::test {

// Ticks of 2 halves: a gap of 3, a lock of 4, a timeout of 12, darkness of 2.
inline constexpr ModeSwitchConfig config{.gap_ticks = 3, .settle_ticks = 4, .lock_timeout_ticks = 12, .dark_ticks = 2};

// What one half shows. Light is in both directions unless it is dark or missed.
struct Half {
    double detuning_lambda = 0.0;
    bool dark = false;
    bool missed = false;
    bool usable = true;
    bool read = true;  // the voltage
};
inline constexpr Half locked{};
inline constexpr Half detuned{.detuning_lambda = 0.2};
inline constexpr Half dark{.dark = true};
inline constexpr Half missed{.missed = true, .read = false};
inline constexpr Half unread{.read = false};

using Halves = std::vector<std::pair<int, Half>>;  // so many of each

class Sequence {
public:
    explicit Sequence(const ModeSwitchConfig& c = config) : config_{c}, state{initial_state(c)} {}

    [[nodiscard]] ModeSwitchInput input(const Half& seen, bool due = false) const {
        return {.due = due,
                .tick_border = half_ % 2 == 1,
                .next_tick = (half_ + 1) / 2,
                .light_known = !seen.missed,
                .two_way = !seen.dark && !seen.missed,
                .usable = seen.usable && !seen.dark && !seen.missed,
                .detuning = Wavelengths{seen.detuning_lambda},
                .piezo = Volts{seen.read ? piezo_v : not_a_number},
                .set_point = Volts{set_point_v},
                .half_wave = Volts{half_wave_v},
                .offset = Volts{offset_v}};
    }
    const ModeSwitchState& half(const ModeSwitchInput& in) {
        ++half_;
        if (const auto ended = step(config_, state, in)) {
            event = *ended;
            ++n_events;
        }
        return state;
    }
    const ModeSwitchState& half(const Half& seen, bool due = false) { return half(input(seen, due)); }
    void halves(int n, const Half& seen) {
        for (int k = 0; k < n; ++k) (void)half(seen);
    }
    void halves(const Halves& all) {
        for (const auto& [n, seen] : all) halves(n, seen);
    }
    void expect(SwitchPhase phase) const { ASSERT_EQ(state.phase, phase); }

    // From `tracking`, at the start of a tick: one tick of `last`, at whose end the loop opens.
    void open(const Half& last = locked) {
        (void)half(last);
        (void)half(last, true);
        expect(SwitchPhase::open);
    }
    // The gap; then the first half of the closed loop is the next.
    void pass_gap(const Half& seen = dark) {
        halves(6, seen);
        ASSERT_TRUE(state.loop_closed);
    }
    void track() {
        halves(8, locked);
        expect(SwitchPhase::tracking);
    }

    // From the start to the state of the name, by the shortest way, ending before the first half of a tick.
    void start() {}
    void to_open() {
        track();
        open();
    }
    void to_settling() {
        to_open();
        pass_gap();
        expect(SwitchPhase::settling);
    }
    void to_returning() {
        to_settling();
        halves(4, dark);
        expect(SwitchPhase::returning);
    }
    void to_searching() {
        to_returning();
        halves(6 + 4, dark);
        expect(SwitchPhase::searching);
    }

private:
    ModeSwitchConfig config_;
    std::int64_t half_ = 0;

public:
    ModeSwitchState state;
    SwitchEvent event;
    int n_events = 0;
    double piezo_v = 160.0;
    double set_point_v = 150.0;
    double half_wave_v = 40.0;
    double offset_v = 0.0;
};

}  // namespace zlg::core::test
