// The compensation of zlg in another program: records of halves in, angles out. Nothing but zlg::core is linked.
//
// usage: embed_core < rows        one half a line: half bias_sign mode counts loop_closed
//
// The table on standard output has one line a tick: number, increment and its sigma in arcsec, flags. It equals what
// `zlg process --set compensation.bridge=quadratic --set compensation.relock=none` makes of a log with these columns.

#include <cstdio>
#include <limits>

#include <zlg/core/gyro_compensation.hpp>

using namespace zlg::core;

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();  // of what this gyro does not measure

void print(const AngleRow& row) {
    std::printf("%lld %.17g %.17g %u\n", static_cast<long long>(row.tick), row.dtheta_final_arcsec, row.sigma_arcsec,
                static_cast<unsigned>(row.flags));
}

}  // namespace

int main() {
    // Of a gyro of one's own: the length of a tick, what a count is worth, the edges of its bias, how large its
    // threshold of lock-in may be.
    const GyroCompensationConfig config{
        .bridge = {.method = BridgeMethod::quadratic},
        .lock_in = {.sigma = Hertz{300.0}},
        .gyro = {.tick = Seconds{0.005}, .scale = Arcsec{3.263}, .plateau_ratio = 1.0 / (1.0 - 50e-6 / 0.005)}};
    if (check(config) != GyroCompensationFault::none) return 2;

    GyroCompensationState state;
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
        const CompensationOutput out = step(config, state, record);
        if (out.has_sample && out.sample.has_final) print(out.sample.final_row);
        ++n_rows;
    }
    if (std::feof(stdin) == 0) {
        std::fprintf(stderr, "embed_core: row %lld: allowed are five whole numbers\n", n_rows + 1);
        return 1;
    }
    for (DrainOutput out = drain(config, state); out.has_row || out.has_gap; out = drain(config, state))
        if (out.has_row) print(out.row);
}
