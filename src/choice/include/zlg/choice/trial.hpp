#pragma once
// What one gyro does in one run: the one way by which a choice meets its gyros.

#include <cstdint>
#include <functional>
#include <string>

#include <zlg/choice/candidate.hpp>
#include <zlg/choice/requirement.hpp>
#include <zlg/sweep/draws.hpp>

namespace zlg::choice {

enum class TrialState { good, lost, refused, untried };

struct Trial {
    TrialState state = TrialState::refused;
    std::string reason;              // one line; empty where good
    double error_arcsec = 0.0;       // of the angle at the end, less the constant drift that both modes share
    std::int64_t switches = 0;       // of known error
    double switch_rms_arcsec = 0.0;  // about the alternating mean
    double alternating_arcsec = 0.0;

    [[nodiscard]] bool meets(double limit_arcsec) const {
        return state == TrialState::good && error_arcsec <= limit_arcsec && error_arcsec >= -limit_arcsec;
    }
};

// Thrown out of a trial that was asked to stop.
struct Stopped {};

using IsStopped = std::function<bool()>;

// Runs the gyro, with the ramps that the requirement adds to its motion.
//
// errors  Stopped; those of a motion file. What is wrong with the gyro is in the result.
[[nodiscard]] Trial try_gyro(const Requirement& requirement, const config::Config& gyro, const IsStopped& is_stopped);

// Gyros drawn over the tolerance. Each is a function of seed and number alone, whatever is chosen for it.
class Population {
public:
    using Change = std::function<void(config::Config&)>;

    // change  of every gyro, after all else; optional.
    Population(const Requirement& requirement, std::uint64_t seed, std::int64_t gyros, Change change = {});

    [[nodiscard]] const Requirement& requirement() const { return requirement_; }

    // errors  config::ConfigError where the drawn values make no gyro.
    [[nodiscard]] config::Config gyro(std::int64_t number, const Candidate& candidate) const;

    // As try_gyro; a gyro that the draws make impossible is `refused`.
    [[nodiscard]] Trial run(std::int64_t number, const Candidate& candidate, config::Fidelity fidelity,
                            const IsStopped& is_stopped) const;

private:
    Requirement requirement_;
    sweep::Description description_;
    sweep::Draws draws_;
    Change change_;
};

}  // namespace zlg::choice
