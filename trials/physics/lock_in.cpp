// Backscatter in one helicity: the dead zone, a dynamic zone, the random walk, with even and with dithered edges.

#include <cmath>
#include <cstdint>
#include <numbers>

#include <zlg/core/common/maths.hpp>
#include <zlg/core/control/edge_dither.hpp>
#include <zlg/twin/slip_phase.hpp>

#include "parts.hpp"

namespace zlg::trials {
namespace {

using namespace report;

constexpr double pi = std::numbers::pi;
constexpr double timer_hz = 1e7;
constexpr double scale_arcsec = 3.263;
constexpr double tick_s = 0.005;
constexpr double edge_s = 50e-6;

struct Gyro {
    double bias_hz = 60e3;  // of the plateau
    double lock_hz = 300.0;
    core::DitherMethod dither = core::DitherMethod::none;
};

// Latched at the reversals as the counter is, but read to parts of a turn.
class LockIn {
public:
    LockIn(const Gyro& g, double rate_arcsec_s)
        : bias_hz_{g.bias_hz},
          rate_hz_{rate_arcsec_s / scale_arcsec},
          coupling_{twin::Backscatter::equal(g.lock_hz, 0.7).coupling(1.0, 1.0)} {
        dither_.method = g.dither;
        dither_.cycle_ticks = timer_hz / g.bias_hz;
        dither_.tick_s = tick_s;
        dither_.scale_arcsec = scale_arcsec;
    }

    // Mean rate of the counts over n periods, known areas of the bias subtracted.
    double mean_arcsec_s(int n) {
        double turns = 0.0;
        for (int i = 0; i < n; ++i) {
            turns += half(1);
            turns += half(-1);
        }
        return scale_arcsec * turns / (n * tick_s);
    }

private:
    double half(int sign) {
        const std::int32_t shift = state_.end_ticks - state_.start_ticks;
        const double length_s = 0.5 * tick_s + shift / timer_hz;
        const double plateau_hz = rate_hz_ + sign * bias_hz_;
        const twin::Turns before = latched_;
        phase_.plateau(plateau_hz, coupling_, length_s - edge_s);
        latched_ = phase_.reversal(plateau_hz, rate_hz_ - sign * bias_hz_, coupling_, edge_s);
        const double turned = latched_.minus(before);
        (void)core::step(dither_, state_, static_cast<std::int8_t>(-sign), {true, std::llround(turned)});
        // The latch moves with the edge: of the rotation meanwhile the nominal half is wanted.
        return turned - sign * bias_hz_ * (length_s - 0.5 * edge_s) - rate_hz_ * shift / timer_hz;
    }

    double bias_hz_;
    double rate_hz_;
    twin::Coupling coupling_;
    twin::SlipPhase phase_;
    twin::Turns latched_;
    core::EdgeDitherConfig dither_;
    core::EdgeDitherState state_;
};

double settled(const Gyro& g, double rate_arcsec_s, int n) {
    LockIn run{g, rate_arcsec_s};
    run.mean_arcsec_s(2000);
    return run.mean_arcsec_s(n);
}

// Random walk from the scatter of stretches of a tenth of a second, deg/sqrt(h).
double walk(const Gyro& g, double rate_arcsec_s) {
    constexpr int n_blocks = 2000;
    constexpr int ticks = 20;
    LockIn run{g, rate_arcsec_s};
    run.mean_arcsec_s(2000);
    double sum = 0.0;
    double square = 0.0;
    for (int i = 0; i < n_blocks; ++i) {
        const double error = run.mean_arcsec_s(ticks) - rate_arcsec_s;
        sum += error;
        square += error * error;
    }
    const double mean = sum / n_blocks;
    return std::sqrt((square / n_blocks - mean * mean) * ticks * tick_s) / 60.0;
}

double slip_rad(const Gyro& g) { return 2.0 * pi * g.lock_hz * std::sqrt(edge_s / (2.0 * g.bias_hz)); }

double walk_formula(const Gyro& g) { return scale_arcsec / (2.0 * pi) * slip_rad(g) / std::sqrt(tick_s) / 60.0; }

double zone_formula(const Gyro& g, int k) {
    const double cycles = 0.5 * g.bias_hz * (tick_s - edge_s);
    return scale_arcsec / (pi * tick_s) * slip_rad(g) * std::abs(core::maths::cos(pi * (cycles + 0.5 * k - 0.25)));
}

double found_zone(const Gyro& g) {
    double held = 0.0;
    double free = 20.0;
    for (int i = 0; i < 10; ++i) {
        const double rate = 0.5 * (held + free);
        (std::abs(settled(g, rate, 8000)) < 0.02 ? held : free) = rate;
    }
    return 0.5 * (held + free);
}

Gyro dithered(Gyro g) {
    g.dither = core::DitherMethod::automatic;
    return g;
}

constexpr Gyro at_rest{.bias_hz = 60320.0};
constexpr Gyro at_first_zone{.bias_hz = 60140.0};

Figure dead_zone() {
    Figure figure{.id = "dead-zone",
                  .title = "Dead zone",
                  .caption = "Rate read against rate turned, lock-in at 300 Hz, bias 60 320 Hz.",
                  .x_label = "rate of the gyro, arcsec/s",
                  .y_label = "rate read, arcsec/s",
                  .series = {blank_series("even edges"), blank_series("edges by law P", Mark::points)},
                  .bands = {{-zone_formula(at_rest, 0), zone_formula(at_rest, 0), "zone by the formula"}}};
    sample(figure.series[0], -20.0, 0.25, 160, [](double rate) { return settled(at_rest, rate, 8000); });
    sample(figure.series[1], -20.0, 1.0, 40, [](double rate) { return settled(dithered(at_rest), rate, 20000); });
    return figure;
}

Figure dynamic_zone() {
    const double centre = scale_arcsec / tick_s;
    const double zone = zone_formula(at_first_zone, 1);
    Figure figure{.id = "dynamic-zone",
                  .title = "The first dynamic zone",
                  .caption = "What is read less what was turned, about K/T = 652.6 arcsec/s, bias 60 140 Hz.",
                  .x_label = "rate of the gyro less K/T, arcsec/s",
                  .y_label = "rate read less rate, arcsec/s",
                  .series = {blank_series("even edges"), blank_series("edges by law R", Mark::points)},
                  .bands = {{-zone, zone, "zone by the formula"}}};
    sample(figure.series[0], -20.0, 0.25, 160,
           [=](double x) { return settled(at_first_zone, centre + x, 8000) - (centre + x); });
    sample(figure.series[1], -20.0, 1.0, 40,
           [=](double x) { return settled(dithered(at_first_zone), centre + x, 20000) - centre - x; });
    return figure;
}

Figure random_walk() {
    Figure figure{
        .id = "random-walk",
        .title = "Random walk that the dither makes",
        .caption =
            "From stretches of a tenth of a second; the line is what slips of independent phases add up "
            "to. Law P below about 50 arcsec/s, R above; at slow rates what is left does not add up, so that longer "
            "stretches show less.",
        .x_label = "rate of the gyro, arcsec/s",
        .y_label = "angle random walk, deg/sqrt(h)",
        .log_x = true};
    for (const double lock_hz : {150.0, 300.0}) {
        const Gyro g{.bias_hz = 60e3, .lock_hz = lock_hz, .dither = core::DitherMethod::automatic};
        const auto colour = static_cast<int>(figure.series.size());
        Series seen = blank_series(fmt::format("f_L = {} Hz", lock_hz), Mark::points);
        Series formula = blank_series(fmt::format("formula, {} Hz", lock_hz), Mark::line, true, colour);
        for (int k = 0; k <= 28; ++k) {
            const double rate = core::maths::exp(0.125 * k * core::maths::log(10.0));
            add_point(seen, rate, walk(g, rate));
        }
        add_point(formula, 1.0, walk_formula(g));
        add_point(formula, core::maths::exp(3.5 * core::maths::log(10.0)), walk_formula(g));
        figure.series.push_back(std::move(seen));
        figure.series.push_back(std::move(formula));
    }
    return figure;
}

}  // namespace

void add_lock_in(PhysicsPictures& made) {
    made.pictures.push_back({"dead_zone", {dead_zone(), dynamic_zone(), random_walk()}});
    const Gyro usual;
    read(made, "largest slip of a reversal at f_L = 300 Hz", {slip_rad(usual)}, 4, "rad");
    std::vector<double> found;
    std::vector<double> formula;
    for (const double bias_hz : {60000.0, 60140.0, 60320.0}) {
        found.push_back(found_zone({.bias_hz = bias_hz}));
        formula.push_back(zone_formula({.bias_hz = bias_hz}, 0));
    }
    read(made, "dead zone, half-width at a bias of 60000, 60140, 60320 Hz: found", found, 2, "arcsec/s");
    read(made, "the same: formula", formula, 2, "arcsec/s");
    const Gyro clean{.lock_hz = 150.0};
    read(made, "random walk at 1000 arcsec/s, f_L = 150, 300 Hz: found",
         {walk(dithered(clean), 1000.0), walk(dithered(usual), 1000.0)}, 4, "deg/sqrt(h)");
    read(made, "the same: formula", {walk_formula(clean), walk_formula(usual)}, 4, "deg/sqrt(h)");
    read(made, "2 arcsec/s at a bias of 60320 Hz, as read with even edges and by law P",
         {settled(at_rest, 2.0, 100'000), settled(dithered(at_rest), 2.0, 100'000)}, 3, "arcsec/s");
    const double ratio = usual.lock_hz / usual.bias_hz;
    read(made, "scale-factor error of lock-in at f_L = 300 Hz, slow rates, formula",
         {1e6 * 0.5 * ratio * ratio * (1.0 - 4.0 * edge_s / tick_s)}, 1, "ppm");
}

}  // namespace zlg::trials
