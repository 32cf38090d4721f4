// Lock-in and its cure in the whole gyro: laser with phases, control, compensation, at rates where backscatter shows.
//
// usage: zlg_laser_lock_in [seconds of gyro time per rate, default 4000]
//
// Every row is a gyro of its own that reads a constant rate through whole counts, quarters of a fringe. Its random walk
// is that of stretches of 2 s, rounding of the counter taken off.

#include <cmath>

#include <fmt/format.h>
#include <zlg/config/config.hpp>
#include <zlg/rig/asked_compensation.hpp>
#include <zlg/rig/closed_loop.hpp>
#include <zlg/rig/laser_calibration.hpp>
#include <zlg/rig/replay.hpp>
#include <zlg/rig/wiring.hpp>

namespace {

using namespace zlg;

constexpr double fringe_arcsec = 3.263;
constexpr double zone_arcsec_s = fringe_arcsec / 0.005;  // distance of the dynamic zones
constexpr int block_ticks = 400;

config::Config gyro(double lock_hz, double field_g, double rate_arcsec_s, core::DitherMethod dither) {
    config::Config c;
    c.gyro.fidelity = config::Fidelity::laser;
    c.gyro.scale_arcsec = fringe_arcsec / 4.0;
    c.laser.quadrature = config::Quadrature::x4;
    c.laser.lock_in_left_hz = lock_hz;
    c.laser.lock_in_right_hz = lock_hz;
    c.laser.bias_field_g = field_g;
    c.drift = {.magnetic_arcsec_s = 0.0, .magnetic_thermal_arcsec_s = 0.0, .nonmagnetic_arcsec_s = 0.0};
    c.switching.interval_s = 1e6;
    c.motion.kind = config::MotionKind::constant;
    c.motion.rate_arcsec_s = rate_arcsec_s;
    c.gyro.dither = dither;
    return rig::calibrated_by_laser(c);
}

struct Reading {
    double error_arcsec_s = 0.0;
    double arw_deg_sqrt_h = 0.0;
};

class Run {
public:
    explicit Run(const config::Config& c) : loop_{c, rig::motion(c)}, replay_{rig::asked_compensation(c)} {}

    // Angle read less angle turned.
    double error_arcsec(int ticks) {
        double turned = 0.0;
        const double before = replay_.angle_arcsec();
        for (int h = 0; h < 2 * ticks; ++h) {
            const rig::LoopHalf half = loop_.advance();
            turned += half.truth.dtheta_arcsec;
            replay_.take(half.record);
        }
        return replay_.angle_arcsec() - before - turned;
    }

private:
    rig::ClosedLoop loop_;
    rig::Replay replay_;
};

Reading read(const config::Config& c, double seconds) {
    Run run{c};
    run.error_arcsec(2000);
    const double block_s = block_ticks * c.gyro.tick_s;
    const int n = static_cast<int>(seconds / block_s);
    double sum = 0.0;
    double square = 0.0;
    for (int i = 0; i < n; ++i) {
        const double error = run.error_arcsec(block_ticks);
        sum += error;
        square += error * error;
    }
    const double mean = sum / n;
    const double rounding = c.gyro.scale_arcsec * c.gyro.scale_arcsec / 6.0;
    return {mean / block_s, std::sqrt(std::max(square / n - mean * mean - rounding, 0.0) / block_s) / 60.0};
}

void print(double lock_hz, double field_g, double rate, core::DitherMethod dither, double seconds) {
    const Reading r = read(gyro(lock_hz, field_g, rate, dither), seconds);
    fmt::print("{:>6.0f}{:>9.3f}{:>10}{:>12.2f}{:>12.4f}{:>10.4f} %{:>10.4f}\n", lock_hz, field_g,
               dither == core::DitherMethod::none ? "none" : "auto", rate, r.error_arcsec_s,
               rate == 0.0 ? 0.0 : 100.0 * r.error_arcsec_s / rate, r.arw_deg_sqrt_h);
}

}  // namespace

int main(int argc, char** argv) {
    const double seconds = argc > 1 ? std::atof(argv[1]) : 4000.0;
    fmt::print("f_L Hz  field G    dither  rate \"/s  error \"/s     error   ARW deg/sqrt h\n");
    using enum core::DitherMethod;
    for (const double rate : {2.0, zone_arcsec_s + 2.0}) print(300.0, 15.0, rate, none, 0.1 * seconds);
    for (const double field_g : {15.0, 15.035, 15.08}) {
        for (const double rate : {0.0, 2.0, -2.0}) print(300.0, field_g, rate, automatic, seconds);
    }
    for (const double rate : {15.0, 45.0, 70.0, 100.0, 130.0, 163.0, 200.0, 250.0, 400.0, 5e3, 20e3, 60e3, -60e3}) {
        print(300.0, 15.0, rate, automatic, seconds);
    }
    for (const double near : {-10.0, -3.0, -1.0, -0.1, 0.0, 0.1, 1.0, 3.0, 10.0}) {
        print(300.0, 15.0, zone_arcsec_s + near, automatic, seconds);
        print(300.0, 15.0, -2.0 * zone_arcsec_s + near, automatic, seconds);
    }
    for (const double rate : {0.0, 2.0, 130.0, 400.0, 5000.0}) print(150.0, 15.0, rate, automatic, seconds);
}
