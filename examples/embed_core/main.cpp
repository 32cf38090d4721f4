// The compensation of zlg in another program: records of halves in, angles out. Nothing but zlg::core is linked.
//
// usage: embed_core < rows        one half a line: half bias_sign mode counts loop_closed
//
// The table on standard output has one line a tick: number, increment and its sigma in arcsec, flags. It equals what
// `zlg process --set compensation.relock=none` makes of a log with these columns. On standard error: what a half-period
// takes, and what is left to the background, where in a gyro the estimates of its switches are made between two halves.
//
// The same source is a program of a Cortex-M7, which speaks through the debugger or QEMU: docs/installing.md.

#include <cstdint>
#include <cstdio>
#include <ctime>
#include <limits>

#include <zlg/core/gyro_compensation.hpp>

using namespace zlg::core;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();  // of what this gyro does not measure

#ifdef __ARM_ARCH_7EM__
// The cycle counter of the processor (DWT_CYCCNT). The emulator has none, and reads 0.
volatile std::uint32_t& reg(std::uint32_t address) { return *reinterpret_cast<volatile std::uint32_t*>(address); }
constexpr const char* clock_unit = "cycles";
// After a reset the floating-point unit is off; who starts a program by its entry has no start-up code that knows it.
[[gnu::constructor]] void start_fpu() {
    reg(0xe000ed88) = reg(0xe000ed88) | 0xfu << 20;
    asm volatile("dsb\n isb" ::: "memory");
}
void start_clock() {
    reg(0xe000edfc) = reg(0xe000edfc) | 1u << 24;  // tracing is on
    reg(0xe0001fb0) = 0xc5acce55;                  // its registers may be written
    reg(0xe0001000) = reg(0xe0001000) | 1u;
}
std::uint32_t now() { return reg(0xe0001004); }
#else
constexpr const char* clock_unit = "us";
void start_clock() {}
std::uint32_t now() { return static_cast<std::uint32_t>(std::clock()); }
#endif

// The longest of the times between `begin` and `end`.
class Longest {
public:
    void begin() { begun_ = now(); }
    void end() {
        const std::uint32_t took = now() - begun_;
        if (took > longest_) longest_ = took;
    }
    [[nodiscard]] unsigned long value() const { return longest_; }

private:
    std::uint32_t begun_ = 0, longest_ = 0;
};

// Not on the stack, which need not hold it.
GyroCompensationState state;

void print(const AngleRow& row) {
    std::printf("%lld %.17g %.17g %u\n", static_cast<long long>(row.tick), row.dtheta_final_arcsec, row.sigma_arcsec,
                static_cast<unsigned>(row.flags));
}

}  // namespace

int main() {
    // Of a gyro of one's own: the length of a tick, what a count is worth, the edges of its bias, how large its
    // threshold of lock-in may be.
    const GyroCompensationConfig config{
        .bridge = {.method = BridgeMethod::automatic},
        .lock_in = {.sigma = Hertz{300.0}},
        .gyro = {.tick = Seconds{0.005}, .scale = Arcsec{3.263}, .plateau_ratio = 1.0 / (1.0 - 50e-6 / 0.005)}};
    if (check(config) != GyroCompensationFault::none) return 2;

    // Estimates wait for `work`; without, a half makes them at its end.
    state.bridge.background.worker.is_background = true;
    start_clock();
    Longest half_period, background;
    long long half = 0, counts = 0, n_rows = 0;
    int bias_sign = 1, mode = 1, closed = 1;
    while (std::scanf("%lld %d %d %lld %d", &half, &bias_sign, &mode, &counts, &closed) == 5) {
        const HalfRecord record{.half = half,
                                .counts = counts,
                                .detuning_lambda = none,
                                .detuning_sq_lambda2 = none,
                                .piezo_v = none,
                                .temperature_c = none,
                                .bias_sign = static_cast<std::int8_t>(bias_sign),
                                .mode = static_cast<std::int8_t>(mode),
                                .loop_closed = closed != 0};
        half_period.begin();
        const CompensationOutput out = step(config, state, record);
        half_period.end();
        background.begin();
        work(config, state);
        background.end();
        if (out.has_sample && out.sample.has_final) print(out.sample.final_row);
        ++n_rows;
    }
    if (std::feof(stdin) == 0) {
        std::fprintf(stderr, "embed_core: row %lld: allowed are five whole numbers\n", n_rows + 1);
        return 1;
    }
    for (DrainOutput out = drain(config, state); out.has_row || out.has_gap; out = drain(config, state))
        if (out.has_row) print(out.row);
    std::fprintf(stderr, "at most %lu %s in a half-period, %lu in the background\n", half_period.value(), clock_unit,
                 background.value());
}
