// Control fed with any frames, under any configuration that passed `check`: every command is one that the electronics
// can obey, every record is finite, and a copy of the state goes on like the original.

#include <cmath>
#include <cstdint>
#include <optional>

#include <zlg/core/gyro_control.hpp>

#include "bytes.hpp"
#include "claim.hpp"

namespace {

using namespace zlg::core;
using zlg::fuzz::Bytes;
using zlg::fuzz::claim;

PiezoRange range_from(Bytes& bytes) {
    PiezoRange range;
    range.min = Volts{bytes.real(10.0)};
    range.max = Volts{bytes.real(300.0)};
    range.margin = Volts{bytes.real(10.0)};
    return range;
}

void loop_from(Bytes& bytes, PerimeterLoopConfig& c) {
    c.half_wave = Volts{bytes.real(40.0)};
    c.half_period = Seconds{bytes.real(0.0025)};
    c.time_constant = Seconds{bytes.real(0.0065)};
    c.error_limit = Wavelengths{bytes.real(0.09)};
    c.slew_v_s = bytes.real(4000.0);
    c.watch_limit = Wavelengths{bytes.real(0.1)};
}

void detector_from(Bytes& bytes, SyncDetectorConfig& c) {
    c.discriminator_per_lambda = bytes.real(0.332);
    c.dark_fraction = bytes.real(0.5);
    c.level_min = bytes.real(0.01);
    c.level_ticks = bytes.take<std::int8_t>();
}

void monitors_on(GyroControlConfig& c) {
    c.limits.bias_counts = 150.0;
    c.limits.coil_ratio = 0.003;
    c.limits.light_noise = Wavelengths{0.0033};
    c.limits.bias_chi = 3.6;
    c.limits.detuning_change_lambda2 = 0.002;
}

GyroControlConfig config_from(Bytes& bytes) {
    GyroControlConfig c;
    c.loop.kind = bytes.flag() ? LoopKind::digital : LoopKind::analog;
    c.schedule.first_segment = bytes.flag() ? FirstSegment::half : FirstSegment::full;
    // Short, so that an input of some hundred bytes meets every phase.
    c.schedule.interval_ticks = 1 + bytes.take<std::uint8_t>() % 64;
    c.mode_switch.gap_ticks = 1 + static_cast<std::int32_t>(bytes.index(4));
    c.mode_switch.gap_min_ticks = c.mode_switch.gap_ticks / 2;
    c.mode_switch.settle_ticks = 1 + static_cast<std::int32_t>(bytes.index(8));
    c.mode_switch.lock_timeout_ticks = c.mode_switch.settle_ticks + 1 + static_cast<std::int32_t>(bytes.index(8));
    c.mode_switch.dark_ticks = 1 + static_cast<std::int32_t>(bytes.index(3));
    c.mode_switch.start_polarity = bytes.sign();
    c.commutator.dither.method = static_cast<DitherMethod>(bytes.index(4));
    if (bytes.flag()) monitors_on(c);
    if (bytes.flag()) return c;
    c.loop.range = c.mode_switch.range = c.half_wave.range = range_from(bytes);
    c.mode_switch.start_set_point = Volts{bytes.real(150.0)};
    c.mode_switch.lock_tolerance = Wavelengths{bytes.real(0.02)};
    loop_from(bytes, c.loop);
    detector_from(bytes, c.detector);
    c.half_wave.half_wave = Volts{bytes.real(40.0)};
    c.half_wave.reference = Celsius{bytes.real(20.0)};
    c.commutator.half_ticks = bytes.take<std::uint64_t>() >> bytes.index(64);
    c.commutator.tolerance_ticks = bytes.take<std::uint8_t>();
    c.presumed_temperature = Celsius{bytes.real(20.0)};
    return c;
}

void spoil_light(Bytes& bytes, SensorFrame& frame) {
    frame.n_light = bytes.take<std::uint8_t>();
    frame.has_light_b = bytes.flag();
    const unsigned at = bytes.index(max_light_samples);
    frame.light_a[at] = static_cast<float>(bytes.flag() ? bytes.real(1.0) : 0.0);
    frame.light_b[at] = static_cast<float>(bytes.flag() ? bytes.real(1.0) : 0.0);
}

void spoil_numbers(Bytes& bytes, SensorFrame& frame) {
    frame.sequence += bytes.take<std::uint8_t>();
    frame.timer_ticks += bytes.take<std::uint64_t>();
    frame.counter += bytes.take<std::uint64_t>();
    frame.bias_sign = bytes.take<std::int8_t>();
    frame.polarity = bytes.take<std::int8_t>();
    frame.loop_closed = bytes.flag();
    frame.piezo_v = bytes.real(150.0);
    frame.temperature_c = bytes.real(20.0);
    frame.coil_current_a = bytes.real(1.0);
    frame.status = bytes.take<std::uint8_t>();
}

// Most frames are a byte: a gyro that obeys, with some detuning or in the dark. Some are of any bits.
SensorFrame frame_from(Bytes& bytes, const SensorFrame& previous, const ActuatorFrame& commanded) {
    const auto what = bytes.take<std::uint8_t>();
    SensorFrame frame;
    frame.sequence = previous.sequence + 1;
    frame.timer_ticks = previous.timer_ticks + 25000;
    frame.counter = previous.counter + what;
    frame.bias_sign = static_cast<std::int8_t>(-previous.bias_sign);
    frame.polarity = commanded.polarity;
    frame.loop_closed = commanded.loop_closed;
    frame.piezo_v = commanded.set_point_v[0];
    frame.temperature_c = 20.0;
    frame.n_light = 4;
    frame.has_light_b = true;
    const float light = (what & 7) == 7 ? 0.0f : 1.0f;
    const float modulation = 0.01f * static_cast<float>((what >> 3) & 7);
    frame.light_a.fill(light + modulation);
    frame.light_b.fill(light - modulation);
    if ((what & 0x40) != 0) spoil_light(bytes, frame);
    if ((what & 0x80) != 0) spoil_numbers(bytes, frame);
    return frame;
}

void claim_command(const GyroControlConfig& c, const ActuatorFrame& a) {
    claim(a.polarity == 1 || a.polarity == -1, "the polarity is a sign");
    claim(a.n_set_points >= 1 && a.n_set_points <= max_set_points, "there are set-points");
    for (unsigned k = 0; k < a.n_set_points; ++k) {
        const double set_point_v = a.set_point_v[k];
        claim(set_point_v >= c.loop.range.min.value() && set_point_v <= c.loop.range.max.value(),
              "set-points lie in the range of the piezo");
    }
}

void claim_record(const GyroControlOutput& out, std::int64_t half) {
    const HalfRecord& r = out.record;
    claim(r.half == half, "halves come in order");
    claim(std::isfinite(r.detuning_lambda), "the detuning is a number");
    claim(r.detuning_sq_lambda2 >= 0.0 && std::isfinite(r.detuning_sq_lambda2),
          "the mean square is a number, 0 or more");
    claim(std::isfinite(r.piezo_v) && std::isfinite(r.temperature_c), "voltage and temperature are numbers");
    claim((r.bias_sign == 1 || r.bias_sign == -1) && (r.mode == 1 || r.mode == -1), "signs are signs");
    claim(std::uint64_t{out.health} < (std::uint64_t{1} << health_bit_names.size()), "every bit has a name");
    claim(!out.has_event || std::isfinite(out.event.half_wave_v), "an event is of numbers");
}

bool same(const GyroControlOutput& a, const GyroControlOutput& b) {
    return a.actuator == b.actuator && a.record == b.record && a.health == b.health && a.has_event == b.has_event &&
           a.event == b.event;
}

void run(const GyroControlConfig& config, Bytes& bytes) {
    GyroControlState state = initial_state(config, bytes.take<std::uint64_t>());
    SensorFrame frame{.counter = state.counter};
    ActuatorFrame commanded = initial_actuator(config);
    claim_command(config, commanded);
    std::optional<GyroControlState> snapshot;
    const unsigned snapshot_at = bytes.take<std::uint8_t>();
    for (unsigned k = 0; !bytes.empty(); ++k) {
        frame = frame_from(bytes, frame, commanded);
        if (k == snapshot_at) snapshot = state;
        const GyroControlOutput out = step(config, state, frame);
        claim_command(config, out.actuator);
        claim_record(out, k);
        claim(state == GyroControlState{state}, "the state holds numbers");
        if (snapshot) {
            claim(same(step(config, *snapshot, frame), out), "a copy gives the same bits");
            claim(*snapshot == state, "a copy stays equal");
        }
        commanded = out.actuator;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes{data, size};
    const GyroControlConfig config = config_from(bytes);
    if (check(config) == GyroControlFault::none) run(config, bytes);
    return 0;
}
