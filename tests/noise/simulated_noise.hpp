#pragma once
// Rates with noise of known terms, made step by step.

#include <numeric>

#include "test.hpp"

namespace zlg::noise {

class SimulatedNoise {
public:
    SimulatedNoise(std::size_t n, double rate_hz, unsigned seed) : rates(n, 0.0), dt_(1.0 / rate_hz), engine_(seed) {}

    void add_white(double n) {
        for (double& r : rates) r += n / std::sqrt(dt_) * normal_(engine_);
    }
    // Behind a moving average of so many samples.
    void add_averaged(double n, std::size_t length) {
        std::vector<double> white(rates.size() + length);
        for (double& w : white) w = n / std::sqrt(dt_) / static_cast<double>(length) * normal_(engine_);
        double sum = std::accumulate(white.begin(), white.begin() + static_cast<std::ptrdiff_t>(length), 0.0);
        for (std::size_t k = 0; k < rates.size(); ++k) {
            rates[k] += sum;
            sum += white[k + length] - white[k];
        }
    }
    // Of a slower sensor, each value of which stands for so many samples.
    void add_held(double n, std::size_t length) {
        double held = 0.0;
        for (std::size_t k = 0; k < rates.size(); ++k) {
            if (k % length == 0) held = n / std::sqrt(dt_ * static_cast<double>(length)) * normal_(engine_);
            rates[k] += held;
        }
    }
    // A counter that rounds down an angle which turns steadily, and after each gap begins anew.
    void add_counted(double rate, double count, std::size_t gap_every) {
        double angle = 0.0, before = 0.0;
        for (std::size_t k = 0; k < rates.size(); ++k) {
            if (k % gap_every == 0) {
                rates[k] = std::numeric_limits<double>::quiet_NaN();
                angle = std::uniform_real_distribution<double>(0.0, count)(engine_);
                before = 0.0;
                continue;
            }
            angle += rate * dt_;
            const double now = count * std::floor(angle / count);
            rates[k] += (now - before) / dt_;
            before = now;
        }
    }
    void add_quantisation(double q) {
        double before = normal_(engine_);
        for (double& r : rates) {
            const double now = normal_(engine_);
            r += q * (now - before) / dt_;
            before = now;
        }
    }
    // Means over the samples of a Brownian rate.
    void add_random_walk(double k) {
        double rate = 0.0;
        for (double& r : rates) {
            const double end = normal_(engine_), inside = normal_(engine_);
            r += rate + k * std::sqrt(dt_) * (0.5 * end + inside / std::sqrt(12.0));
            rate += k * std::sqrt(dt_) * end;
        }
    }
    void add_ramp(double slope) {
        for (std::size_t k = 0; k < rates.size(); ++k) rates[k] += slope * dt_ * (static_cast<double>(k) + 0.5);
    }
    // Sampled; the time is to be long against a sample.
    void add_markov(double deviation, double time_s) {
        const double factor = std::exp(-dt_ / time_s);
        double b = deviation * normal_(engine_);
        for (double& r : rates) {
            r += b;
            b = factor * b + deviation * std::sqrt(1.0 - factor * factor) * normal_(engine_);
        }
    }
    // 1/f as a sum of exponentially correlated processes, an octave apart.
    void add_flicker(double b) {
        const double deviation = b * std::sqrt(std::numbers::ln2 / std::numbers::pi);
        for (double t = 2.0 * dt_; t < 100.0 * dt_ * static_cast<double>(rates.size()); t *= 2.0)
            add_markov(deviation, t);
    }
    // Means over the samples.
    void add_sine(double amplitude, double frequency_hz) {
        const double x = std::numbers::pi * frequency_hz * dt_;
        amplitude *= std::sin(x) / x;
        for (std::size_t k = 0; k < rates.size(); ++k)
            rates[k] +=
                amplitude * std::cos(2.0 * std::numbers::pi * frequency_hz * dt_ * static_cast<double>(k) + 1.0);
    }

    std::vector<double> rates;

private:
    double dt_;
    std::mt19937_64 engine_;
    std::normal_distribution<double> normal_;
};

}  // namespace zlg::noise
