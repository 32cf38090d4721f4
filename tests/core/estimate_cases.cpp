// Estimates of switches whose windows come as numbers on the standard input, for the test that holds them against the
// reference in NumPy (tests/reference). One case after the other; for each, one line: known, angle, variance, scale,
// its variance, then angle and variance of each row.

#include <array>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <zlg/core/compensation/switch_estimate.hpp>

namespace {

using namespace zlg::core;

// Also `inf` and `nan`.
double number() {
    std::string word;
    std::cin >> word;
    return std::strtod(word.c_str(), nullptr);
}

int whole() { return static_cast<int>(number()); }

CompensationConstants constants() {
    CompensationConstants gyro;
    gyro.scale = Arcsec{number()};
    gyro.bias = Hertz{number()};
    gyro.chi = number();
    gyro.light_noise = Wavelengths{number()};
    gyro.tick = Seconds{number()};
    gyro.random_walk = ArcsecPerRootSecond{number()};
    gyro.fringe_noise_counts = number();
    return gyro;
}

void read_moments(MotionMoments& motion) {
    for (int i = 0; i < motion.length; ++i)
        for (int j = 0; j < motion.length; ++j) motion.sum[moment_place(motion.length, i, j)] = number();
}

SwitchWindow window_of(int n_rows) {
    SwitchWindow window;
    window.n_rows = n_rows;
    const int gap = whole();
    window.gap = {gap, whole()};
    window.n_halves = whole();
    window.light_start = window.gap.last;
    return window;
}

void read_rows(SwitchWindow& window) {
    for (WindowRow& row : std::span{window.row}.first(static_cast<unsigned>(window.n_rows))) {
        const int first = whole();
        row.halves = {first, whole()};
        row.read = whole() != 0;
        row.wanted = whole() != 0;
        row.error_arcsec2 = number();
        row.common_arcsec = number();
        row.after_gap = row.halves.first >= window.gap.first;
    }
}

void read_halves(SwitchWindow& window) {
    for (WindowRow& row : std::span{window.row}.first(static_cast<unsigned>(window.n_rows)))
        for (int h = row.halves.first; h < row.halves.last; ++h) {
            const double y = number();
            if (row.read) row.y_arcsec += y;
        }
    for (int h = 0; h < window.n_halves; ++h)
        window.bias_sign[static_cast<unsigned>(h)] = static_cast<std::int8_t>(whole());
}

void read_light(SwitchWindow& window, int halves, int samples) {
    if (halves > 0) window.light.basis = light_basis(halves);
    std::vector<double> light(static_cast<unsigned>(samples));
    for (int h = 0; h < halves; ++h) {
        for (double& x : light) x = number();
        add(window.light, h, light);
    }
}

void answer(EstimateRoom& room) {
    const auto n_bank = static_cast<std::size_t>(whole());
    SwitchWindow window = window_of(whole());
    const int light_halves = whole();
    const int samples = whole();
    const CompensationConstants gyro = constants();
    window.with_phase = whole() != 0;
    RelockScale scale{number(), 0.0};
    scale.variance = number();
    window.magnetic_variance_arcsec2 = number();
    MotionMoments motion{.length = window.n_halves, .n_windows = number()};
    read_rows(window);
    read_moments(motion);
    read_halves(window);
    read_light(window, light_halves, samples);
    const SwitchEstimate e = estimate(gyro, window, motion, scale, room, std::span{motion_bank}.first(n_bank));
    std::cout << e.known << ' ' << e.angle_arcsec << ' ' << e.variance_arcsec2 << ' ' << e.scale.value << ' '
              << e.scale.variance;
    for (int r = 0; r < window.n_rows; ++r) {
        const RowEstimate& row = e.row[static_cast<unsigned>(r)];
        std::cout << ' ' << row.angle_arcsec << ' ' << row.variance_arcsec2;
    }
    std::cout << '\n';
}

}  // namespace

int main() {
    const auto room = std::make_unique<EstimateRoom>();
    std::cout << std::setprecision(17);
    while (std::cin >> std::ws && std::cin.peek() != std::char_traits<char>::eof()) answer(*room);
}
