#pragma once
// What the closed forms say of a candidate before it is tried: they rank and discard.
//
//   error at the end = M + a + N(0, m s^2 + W^2 t + K^2/6)
//
// with M the angle that the alternating magnetic drift leaves (exact), m the switches of the run, s the rms and a the
// alternating mean of their errors by a short trial, W the random walk, K the worth of a count. By phase it is K^2/12:
// the first ticks are counted, until the ellipse of the photodiodes is learnt, so that the place at the start stays
// unknown. The false angle a is there after every odd switch and taken back by the next: a run that ends half an
// interval sooner or later ends with it, so that it counts after an even number of switches too. What a schedule that
// measures and the estimate of the magnetic drift leave of M no closed form says: for them M is 0 where it would
// discard, and whole where it ranks.

#include <map>
#include <tuple>
#include <vector>

#include <zlg/choice/trial.hpp>
#include <zlg/design/magnetic_angle.hpp>

namespace zlg::choice {

// Mean squares over the gyros, arcsec^2, of the parts of the error at the end.
struct Parts {
    double magnetic = 0.0;
    double switches = 0.0;
    double alternating = 0.0;
    double walk = 0.0;
    double rounding = 0.0;

    [[nodiscard]] double sum() const { return magnetic + switches + alternating + walk + rounding; }
};

struct SwitchLaw {
    double rms_arcsec = 0.0;  // infinite where no fair part of the switches was made
    double alternating_arcsec = 0.0;
};

// Of the motion, without which nothing is known of a switch of this gyro.
[[nodiscard]] double least_trial_s(const config::Config& gyro);

[[nodiscard]] double first_switch_s(const Candidate& candidate);

// Switches before the end of the run.
[[nodiscard]] std::int64_t switches_until(double run_s, const Candidate& candidate);

// The angle that the magnetic drift leaves at the end of a run, with its sign.
[[nodiscard]] double magnetic_angle_arcsec(const design::GyroDrift& gyro, double run_s, const Candidate& candidate);

class Forecast {
public:
    // population  outlives it.
    Forecast(const Population& population, int threads, IsStopped is_stopped);

    // Of the gyros that meet the limit.
    //
    // rms_ratio  by which the errors of the switches are taken.
    [[nodiscard]] double chance(const Candidate& candidate, double rms_ratio = 1.0);

    // Of the magnetic drift what a fixed schedule without an estimate leaves.
    [[nodiscard]] Parts parts(const Candidate& candidate);

    // Whether less of it is left, which no closed form says.
    [[nodiscard]] bool leaves_unknown(const Candidate& candidate) const;

    // Those that another forecast learns, in place of its own: of gyros that differ in what a trial is without.
    void take_laws(Forecast& other, const Method& method) { laws_[key(method)] = other.laws(method); }

    // Of one gyro of this method: rms of a switch over the gyros that were tried.
    [[nodiscard]] double switch_rms_arcsec(const Method& method);

private:
    struct Gyro {
        design::GyroDrift drift;
        double walk_arcsec_sqrt_s = 0.0;
        double rounding_arcsec2 = 0.0;
    };
    using Key = std::tuple<core::RelockMethod, core::BridgeMethod, Reading, double>;

    static Key key(const Method& m) { return {m.relock, m.bridge, m.reading, m.tick_s}; }

    // Of each gyro and law that go together.
    [[nodiscard]] std::vector<Parts> all_parts(const Candidate& candidate);
    const std::vector<SwitchLaw>& laws(const Method& method);
    [[nodiscard]] SwitchLaw learnt(std::int64_t number, const Method& method) const;
    [[nodiscard]] Parts parts_of(const Gyro& gyro, const SwitchLaw& law, const Candidate& candidate) const;
    const std::vector<Gyro>& gyros(const Method& method);

    const Population& population_;
    int threads_;
    IsStopped is_stopped_;
    std::map<Key, std::vector<SwitchLaw>> laws_;
    std::map<std::pair<double, Reading>, std::vector<Gyro>> gyros_;
};

}  // namespace zlg::choice
