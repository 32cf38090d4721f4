#include <zlg/core/control/counter_monitor.hpp>

#include <bit>

namespace zlg::core {
namespace {

constexpr int part_bits = 8;  // of a count: 1/256
constexpr std::int32_t count = 1 << part_bits;

// Larger than the error of any bit that is judged.
constexpr int most_bit = 12;
constexpr std::int32_t most_error = std::int32_t{1} << (most_bit + 1 + part_bits);

// Counts in a tick that the rate can hold: 2^18.
constexpr std::int32_t most_step = std::int32_t{1} << (18 + part_bits);

constexpr std::int32_t lost_debounce = 4;
constexpr std::int32_t passed_debounce = 6;
constexpr std::int32_t calm_halves = 400;

// Of even rotation: the rounding of counts. A stuck bit that looked like roughness is so tried again every second.
constexpr std::int32_t smooth = 48;

// To the last bit, and never an overflow.
std::int32_t size(std::int32_t x) noexcept { return x ^ (x >> 31); }

std::int32_t difference(std::uint32_t a, std::uint32_t b) noexcept { return static_cast<std::int32_t>(a - b); }

void remember(CounterMonitorState& s, std::uint32_t place) noexcept { s.place = {place, s.place[0]}; }

// The first readings of a stretch: two of each sign.
void begin(CounterMonitorState& s, std::uint32_t place) noexcept {
    if (++s.n_known == 4) {
        const std::int32_t step = difference(place, s.place[1]);
        s.rate = step > -most_step && step < most_step ? step * 16 : 0;
        s.n_lost = 0;
        s.suspect.error_of = {};
        s.suspect.has_from = false;
    }
    remember(s, place);
}

// A bit that changes is not stuck.
void acquit(CounterMonitorState& s, std::uint32_t reading) noexcept {
    if ((reading & s.suspect.value) == s.suspect.shown) return;
    s.cleared |= s.suspect.value;
    s.suspect = {};
    s.stuck = false;
}

// The bit whose value is nearest to that size; 0 where it is none that is judged, or was found to change.
std::uint32_t bit_near(const CounterMonitorState& s, std::int32_t apart, std::int32_t tolerance) noexcept {
    if (apart >= most_error) return 0;
    const auto nearest = static_cast<std::uint32_t>(apart + apart / 3) >> part_bits;
    const std::uint32_t value = std::bit_floor(nearest) & ~s.cleared;
    const auto error = static_cast<std::int32_t>(value << part_bits);
    const bool good = value > 1 && tolerance <= error && size(apart - error) <= tolerance;
    return good ? value : 0;
}

// A step that the rate does not explain. After some the counter is followed anew.
void lose(CounterMonitorState& s, std::int32_t apart, std::uint32_t predicted) noexcept {
    remember(s, predicted);
    s.suspect.error_of = {s.suspect.error_of[1], s.suspect.error_of[0]};
    if (++s.n_lost < lost_debounce) return;
    s.n_known = 0;
    s.n_lost = 0;
    s.cleared = 0;
    if (!s.stuck) s.suspect = {};
    const std::int32_t most = 256 * count;
    s.rough += ((apart < most ? apart : most) - s.rough) / 64;
}

// How far the counter has gone without the error, at readings of one bias sign.
void pass(CounterMonitorState& s, std::uint32_t true_reading, bool toggled) noexcept {
    SuspectedBit& bit = s.suspect;
    if (!bit.has_from) {
        bit.from = true_reading;
        bit.has_from = true;
        bit.has_toggled = false;
        return;
    }
    bit.has_toggled = bit.has_toggled || toggled;
    const std::int32_t way = difference(true_reading, bit.from);
    const auto value = static_cast<std::int32_t>(bit.value);
    if (!bit.has_toggled || (way < value && way > -value)) return;
    if ((way > 0) != bit.upwards) bit.n_passed = 0;
    bit.upwards = way > 0;
    bit.from = true_reading;
    bit.has_toggled = false;
    bit.n_calm = 0;
    ++bit.n_passed;
    if (bit.n_passed >= passed_debounce) {
        bit.n_passed = passed_debounce;
        s.stuck = true;
    }
}

void follow(CounterMonitorState& s, std::uint32_t reading, std::uint32_t predicted, std::int32_t d,
            std::int8_t error) noexcept {
    if (s.n_lost > 0) --s.n_lost;
    remember(s, predicted + static_cast<std::uint32_t>(d >> 2));
    s.rate = static_cast<std::int32_t>(static_cast<std::uint32_t>(s.rate) + static_cast<std::uint32_t>(d));
    s.rough += (size(d) - s.rough) >> 6;
    SuspectedBit& bit = s.suspect;
    if (bit.value != 0 && !s.is_odd)
        pass(s, reading - static_cast<std::uint32_t>(error) * bit.value, error != bit.error_of[1]);
    bit.error_of = {error, bit.error_of[0]};
    if (++bit.n_calm < calm_halves) return;
    bit = {};
    s.cleared = 0;
    if (s.rough > smooth) s.rough = smooth;
    s.stuck = false;
}

void compare(CounterMonitorState& s, std::uint32_t reading) noexcept {
    const std::uint32_t predicted = s.place[1] + static_cast<std::uint32_t>(s.rate >> 4);
    const std::int32_t d = difference(reading << part_bits, predicted);
    const std::int32_t tolerance = count + 2 * s.rough;
    const std::int32_t apart = size(d);
    const auto of_bit = [&] { return static_cast<std::int32_t>(s.suspect.value << part_bits); };
    bool is_error = s.suspect.value != 0 && apart > of_bit() / 2;
    if (size(is_error ? apart - of_bit() : apart) > tolerance) {
        const bool open = s.suspect.n_passed == 0;
        const std::uint32_t value = open ? bit_near(s, apart, tolerance) : 0;
        if (value == 0) return lose(s, apart, predicted);
        s.suspect = {.value = value, .shown = reading & value};
        is_error = true;
    }
    const auto error = static_cast<std::int8_t>(is_error ? (d > 0 ? 1 : -1) : 0);
    follow(s, reading, predicted, d - error * of_bit(), error);
}

}  // namespace

bool step(CounterMonitorState& state, bool counted, std::uint64_t reading) noexcept {
    const auto low = static_cast<std::uint32_t>(reading);
    acquit(state, low);
    state.is_odd = !state.is_odd;
    if (!counted) state.n_known = 0;
    if (state.n_known < 4)
        begin(state, low << part_bits);
    else
        compare(state, low);
    return state.stuck;
}

}  // namespace zlg::core
