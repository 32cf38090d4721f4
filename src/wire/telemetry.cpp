#include <zlg/wire/telemetry.hpp>

#include "packing.hpp"

namespace zlg::wire {
namespace {

constexpr std::size_t body_bytes = 108;

enum Content : std::uint8_t { content_tick = 1, content_settled = 2, content_synchronised = 4 };
constexpr std::uint8_t contents = content_tick | content_settled | content_synchronised;

void settle(TelemetryState& state, const core::AngleRow& row, Telemetry& t) noexcept {
    state.settled_angle.add(row.dtheta_arcsec);
    state.settled_final_angle.add(row.dtheta_final_arcsec);
    t.has_settled = true;
    t.settled_age_ticks = static_cast<std::uint16_t>(state.tick - row.tick);
    t.settled_mode = row.mode;
    t.settled_flags = row.flags;
    t.settled_dtheta_arcsec = row.dtheta_arcsec;
    t.settled_final_arcsec = row.dtheta_final_arcsec;
    t.settled_sigma_arcsec = row.sigma_arcsec;
}

void complete(const TelemetryState& state, const TickReport& report, Telemetry& t) noexcept {
    t.tick = static_cast<std::uint32_t>(state.tick);
    t.angle = state.angle.high;
    t.settled_angle = state.settled_angle.high;
    t.settled_final_angle = state.settled_final_angle.high;
    t.mode = report.mode;
    t.health = report.health;
    t.temperature_c = static_cast<float>(report.temperature_c);
    t.tick_s = report.tick_s;
    t.time = report.time;
}

// Of one tick: beyond, the register itself could not tell it.
constexpr double max_arcsec = 0x1p35;

// Of the flags; those above are left to whoever keeps the rows.
constexpr std::uint32_t flags_of_the_gyro = 0xFFFF;

// What no member of its own holds: bits, and bytes that are 0.
struct Rest {
    std::uint8_t content = 0;
    std::uint8_t zero = 0;
    std::uint16_t zeros = 0;
};

// The numbers of the body in their order.
template <class Codec, class AnyTelemetry> void lay_out(Codec&& codec, AnyTelemetry& t, Rest& rest) noexcept {
    codec(t.tick, t.settled_age_ticks, rest.content, rest.zero, t.angle, t.dtheta_arcsec, t.flags, t.health, t.mode,
          t.settled_mode, rest.zeros, t.temperature_c, t.settled_dtheta_arcsec, t.settled_final_arcsec,
          t.settled_sigma_arcsec, t.settled_angle, t.settled_final_angle, t.settled_flags, t.time.n_pulses,
          t.time.since_pulse_ticks, t.time.timer_ticks, t.tick_s);
}

bool is_possible(const Telemetry& t) noexcept {
    if (((t.flags | t.settled_flags) & ~flags_of_the_gyro) != 0) return false;
    if (!is_sign(t.mode) || !is_sign(t.settled_mode)) return false;
    for (const double angle_arcsec : {t.dtheta_arcsec, t.settled_dtheta_arcsec, t.settled_final_arcsec})
        if (!(angle_arcsec > -max_arcsec && angle_arcsec < max_arcsec)) return false;
    if (t.has_settled && t.settled_age_ticks > max_settled_age_ticks) return false;
    const bool sigma_is_known = is_number(t.settled_sigma_arcsec);
    return t.settled_sigma_arcsec >= 0.0 && !(sigma_is_known && t.settled_sigma_arcsec >= max_arcsec) &&
           t.tick_s >= min_tick_s && t.tick_s <= max_tick_s;
}

}  // namespace

Telemetry telemetry_of(TelemetryState& state, const core::AngleSample& sample, const TickReport& report) noexcept {
    Telemetry t;
    state.tick = sample.tick;
    state.angle.add(sample.dtheta_arcsec);
    t.flags = sample.flags;
    t.dtheta_arcsec = sample.dtheta_arcsec;
    if (sample.has_final) settle(state, sample.final_row, t);
    complete(state, report, t);
    return t;
}

Telemetry telemetry_of(TelemetryState& state, const core::AngleRow& row, const TickReport& report) noexcept {
    Telemetry t;
    t.has_tick = false;
    settle(state, row, t);
    complete(state, report, t);
    return t;
}

void skip(TelemetryState& state, const TelemetryState& of_them) noexcept {
    state.angle.add(of_them.angle);
    state.settled_angle.add(of_them.settled_angle);
    state.settled_final_angle.add(of_them.settled_final_angle);
    state.tick = of_them.tick;
}

Frame frame_of(Sender& sender, const Telemetry& t) noexcept {
    Rest rest;
    rest.content = static_cast<std::uint8_t>((t.has_tick ? content_tick : 0) | (t.has_settled ? content_settled : 0) |
                                             (t.time.synchronised ? content_synchronised : 0));
    Packer p;
    lay_out(p, t, rest);
    return frame_of(sender, MessageType::telemetry, p.body());
}

std::optional<Telemetry> telemetry_in(const Message& message) noexcept {
    if (message.type != MessageType::telemetry || message.body.size() != body_bytes) return std::nullopt;
    Telemetry t;
    Rest rest;
    lay_out(Unpacker{message.body}, t, rest);
    if ((rest.content & ~contents) != 0 || rest.zero != 0 || rest.zeros != 0) return std::nullopt;
    t.has_tick = (rest.content & content_tick) != 0;
    t.has_settled = (rest.content & content_settled) != 0;
    t.time.synchronised = (rest.content & content_synchronised) != 0;
    if (!is_possible(t)) return std::nullopt;
    return t;
}

}  // namespace zlg::wire
