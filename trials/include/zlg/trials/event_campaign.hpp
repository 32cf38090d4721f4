#pragma once
// Whether gyros from event to event (gyro.fidelity = "events") follow the law of those that live every half.
//
// Unlike gyros are run both ways, by seeds that the two ways do not share. Of every run that is a number: the mean of
// its switch errors with the sign of the false angle, their mean square, the share of them below the 10th, 50th and
// 90th percentile of all that live, the mean of their sigma, the drift, its square about the mean, and the same of the
// angle at the end. Each number has a mean over the runs of either way; z is the normal deviate that is as rare as
// Welch's t of both.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>

namespace zlg::trials {

struct EventCampaign {
    std::int64_t gyros = 60;
    std::int64_t runs = 16;   // of a gyro, either way
    double switches = 12.0;   // of a run, about
    double longest_s = 1300;  // of it
    std::uint64_t seed = 1;
    int threads = 1;
};

inline constexpr std::array event_numbers{"mean",  "mean square", "below p10", "below p50", "below p90",
                                          "sigma", "drift",       "drift^2",   "end",       "end^2"};

struct EventFigures {
    std::string gyro;  // its settings
    double halves = 0.0;
    double lived_s = 0.0, leapt_s = 0.0;  // of one core
    std::array<double, event_numbers.size()> z{};
};

// Gyro k: interval, loop, motion, readout and the rest taken in turn, so that each meets each.
[[nodiscard]] config::Config event_gyro(std::int64_t k, std::string* settings = nullptr);

[[nodiscard]] std::vector<EventFigures> run(const EventCampaign& campaign);

// A row for each gyro, the histogram of z beside that of the normal law, and how fast.
[[nodiscard]] std::string markdown(const std::vector<EventFigures>& figures);

// One line where the mean of z^2, or the largest of them, is beyond chance: one campaign in a thousand.
[[nodiscard]] std::string complaint(const std::vector<EventFigures>& figures);

}  // namespace zlg::trials
