// The twin and the core in closed loop on one thread, in multiples of real time and of a known piece of work.
//
// The reference is noise: as many normal deviates as the half-periods need, from Boost's Mersenne twister and ziggurat,
// which any program can draw. It is done in turn with the work, so that a machine that slows down slows both.

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <vector>

#include <fmt/format.h>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <zlg/config/config.hpp>
#include <zlg/core/gyro_compensation.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/wiring.hpp>

namespace {

using namespace zlg;

constexpr int n_halves = 400'000;
constexpr int n_pairs = 5;
constexpr double max_times_noise = 6.0;
constexpr double max_times_noise_of_laser = 30.0;
volatile double sink = 0.0;  // what is computed must not be left out

void draw_noise(const config::Config& config) {
    boost::random::mt19937_64 engine{1};
    boost::random::normal_distribution<double> normal;
    const auto per_half = static_cast<std::int64_t>(2 * config.gyro.light_samples + 2);
    double sum = 0.0;
    for (std::int64_t k = 0; k < n_halves * per_half; ++k) sum += normal(engine);
    sink = sum;
}

void run_twin(const config::Config& config) {
    twin::Twin twin{rig::twin_config(config), rig::motion(config)};
    const core::ActuatorFrame actuator = initial_actuator(rig::control_config(config));
    double sum = 0.0;
    for (int k = 0; k < n_halves; ++k) sum += twin.advance(actuator).truth.perimeter_v;
    sink = sum;
}

void run_loop(const config::Config& config) {
    rig::ClosedLoop loop{config, rig::motion(config)};
    double sum = 0.0;
    for (int k = 0; k < n_halves; ++k) sum += loop.advance().record.detuning_lambda;
    sink = sum;
}

void run_loop_and_compensation(const config::Config& config) {
    rig::ClosedLoop loop{config, rig::motion(config)};
    const auto compensation = rig::asked_compensation(config);
    core::GyroCompensationState state;
    double sum = 0.0;
    for (int k = 0; k < n_halves; ++k) sum += step(compensation, state, loop.advance().record).angle_arcsec;
    sink = sum;
}

double processor_s(const config::Config& config, void (*work)(const config::Config&)) {
    const std::clock_t start = std::clock();
    work(config);
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// How many times as long as its noise the work takes: the median of pairs, after one to warm up.
double measure(const char* what, const config::Config& config, void (*work)(const config::Config&)) {
    std::vector<double> ratios, works_s;
    for (int k = 0; k <= n_pairs; ++k) {
        const double noise_s = processor_s(config, draw_noise);
        const double work_s = processor_s(config, work);
        if (k == 0) continue;
        works_s.push_back(work_s);
        ratios.push_back(work_s / noise_s);
    }
    std::ranges::sort(ratios);
    const double half_s = std::ranges::min(works_s) / n_halves;
    fmt::print("{:<44}{:>6.0f} times real time, {:>5.0f} ns a half-period, {:.2f} times its noise ({:.2f}..{:.2f})\n",
               what, 0.5 * config.gyro.tick_s / half_s, 1e9 * half_s, ratios[n_pairs / 2], ratios.front(),
               ratios.back());
    return ratios[n_pairs / 2];
}

}  // namespace

int main() {
    config::Config config;
    config.gyro.light_samples = 16;
    measure("twin, 16 light samples", config, run_twin);
    const double loop = measure("twin + control", config, run_loop);
    const double all = measure("twin + control + compensation", config, run_loop_and_compensation);
    config.gyro.fidelity = config::Fidelity::laser;
    measure("laser with phases, 16 light samples", config, run_twin);
    const double laser = measure("laser with phases + control", config, run_loop);
    config.gyro.fidelity = config::Fidelity::averaged;
    config.gyro.light_samples = 64;
    measure("twin + control + compensation, 64 samples", config, run_loop_and_compensation);
    fmt::print("allowed: {:.0f} times its noise with 16 samples, of a laser {:.0f}\n", max_times_noise,
               max_times_noise_of_laser);
    return loop <= max_times_noise && all <= max_times_noise && laser <= max_times_noise_of_laser ? 0 : 1;
}
