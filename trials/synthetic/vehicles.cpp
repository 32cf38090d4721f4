#include "vehicles.hpp"

#include <algorithm>

#include "motion.hpp"

namespace zlg::trials {
namespace {

// What moves one axis in one kind of stretch, and the white noise of what recorded it.
struct Regime {
    MotionLaw motion;
    double longest_s = 40.0;  // stretches last from a quarter of it to all of it
};

struct Vehicle {
    const char* name;
    double noise_arcsec;  // of a row, white
    std::vector<Regime> regimes;
};

MotionLaw bands(std::vector<Band> all) { return {.bands = std::move(all)}; }

std::vector<Vehicle> vehicles() {
    const Regime still{bands({{0.1, 2.0, 1.0}, {20.0, 40.0, 5.0}}), 30.0};
    Regime idle{bands({{0.3, 3.0, 20.0}}), 30.0};
    idle.motion.tones = {{24.7, 60.0}, {49.4, 15.0}};
    const Regime road{bands({{0.02, 0.2, 6000.0}, {0.8, 2.5, 2500.0}, {7.0, 14.0, 800.0}, {20.0, 60.0, 200.0}}), 60.0};
    Regime bumps = road;
    bumps.motion.shocks = {.per_s = 0.5, .rate_arcsec_s = 12000.0, .ring_hz = 9.0, .decay_s = 0.15};
    Regime tracks{bands({{0.02, 0.2, 3000.0}, {0.5, 2.0, 1500.0}, {10.0, 80.0, 400.0}}), 60.0};
    tracks.motion.tones = {{31.0, 700.0}, {62.0, 200.0}};
    const Regime swell{bands({{0.07, 0.15, 4000.0}, {0.4, 1.0, 300.0}}), 80.0};
    Regime engine = swell;
    engine.motion.tones = {{11.3, 40.0}};
    engine.motion.bands.push_back({5.0, 90.0, 25.0});
    const Regime swaying{bands({{0.2, 0.6, 40.0}, {1.5, 6.0, 15.0}}), 60.0};
    return {{"car", 0.0, {idle, road, bumps, road}},
            {"car, noisy sensor", 2.0, {idle, road, bumps}},
            {"tracked vehicle", 0.2, {idle, tracks, tracks}},
            {"ship", 0.0, {swell, engine}},
            {"swaying base", 0.1, {swaying, still}}};
}

// One axis: stretches of the regimes in turn, faded into each other over two seconds.
std::vector<double> axis_of(const Vehicle& vehicle, double rate_hz, std::int64_t rows, std::uint64_t seed,
                            std::uint64_t axis) {
    chance::Draw draw{seed, chance::Cause::vehicle, axis};
    const double row_s = 1.0 / rate_hz;
    std::vector<SyntheticMotion> motions;
    for (const Regime& r : vehicle.regimes)
        motions.emplace_back(
            r.motion, row_s,
            chance::Draw{seed, chance::Cause::vehicle_motion, axis, static_cast<std::uint32_t>(motions.size())});
    std::vector<double> share(motions.size(), 0.0);
    std::size_t now = 0;
    share[0] = 1.0;
    double left_s = vehicle.regimes[0].longest_s * (0.25 + 0.75 * draw.uniform());
    std::vector<double> increments(static_cast<std::size_t>(rows));
    for (double& x : increments) {
        for (std::size_t k = 0; k < motions.size(); ++k) {
            share[k] = std::clamp(share[k] + (k == now ? 0.5 : -0.5) * row_s, 0.0, 1.0);
            const double part = motions[k].advance();
            x += share[k] * part;
        }
        if (vehicle.noise_arcsec > 0.0) x += vehicle.noise_arcsec * draw.normal();
        left_s -= row_s;
        if (left_s > 0.0) continue;
        now = (now + 1) % motions.size();
        left_s = vehicle.regimes[now].longest_s * (0.25 + 0.75 * draw.uniform());
    }
    return increments;
}

}  // namespace

std::vector<VehicleRecord> vehicle_records(bool quick, std::uint64_t seed) {
    std::vector<VehicleRecord> all;
    for (const Vehicle& vehicle : vehicles()) {
        VehicleRecord record{.name = vehicle.name};
        for (std::uint64_t axis = 0; axis < (quick ? 1u : 3u); ++axis)
            record.increment_arcsec.push_back(
                axis_of(vehicle, record.rate_hz, quick ? 60'000 : 200'000, seed, (all.size() << 8) + axis));
        all.push_back(std::move(record));
    }
    return all;
}

}  // namespace zlg::trials
