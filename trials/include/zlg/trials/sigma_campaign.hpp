#pragma once
// Is the sigma that is claimed for a switch true, whatever the motion? Random gyros in random steady motions.
//
// A gyro has a count of 0.3 to 4.35 arcsec, a bias of a random fraction, gaps of 1 to 10 ticks, and a miss where its
// re-lock is corrected. Each class of motion is judged over the gyros: at rest, and in what repeats with the ticks, the
// error of one gyro is hardly random, that of many is.

#include <cstdint>
#include <string>
#include <vector>

#include <zlg/trials/accuracy.hpp>

namespace zlg::trials {

struct SigmaTask {
    double share = 1.0;  // of the gyros
    std::uint64_t seed = 1;
    int threads = 2;
};

struct SigmaFigures {
    std::string motion;
    std::string method;
    ErrorFigures whole;    // of the switches
    double ticks_nev = 0;  // mean of (error/sigma)^2 of the ticks in the gaps
};

// The figures do not depend on the number of threads.
[[nodiscard]] std::vector<SigmaFigures> run_sigma_campaign(const SigmaTask& task);

// A sigma for every switch, and a mean square of error over sigma within .25 to 1.4, or outside by less than what
// chance makes of such a class.
[[nodiscard]] bool is_true(const SigmaFigures& figures);

[[nodiscard]] std::string campaign_text(const std::vector<SigmaFigures>& figures);

}  // namespace zlg::trials
