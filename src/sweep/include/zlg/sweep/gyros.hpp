#pragma once
// The gyros of a sweep, each of which can be run alone.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <zlg/config/config.hpp>
#include <zlg/sweep/description.hpp>
#include <zlg/sweep/draws.hpp>
#include <zlg/sweep/motion_files.hpp>

namespace zlg::sweep {

enum class Status : std::int64_t {
    good,
    refused,     // the drawn values make no gyro, or one beyond the range of its counter
    lost,        // every switch that was due has failed, or more than one in ten, of which some were withheld
    no_switch,   // a metric of the switches, and none of them was completed and repaired
    not_finite,  // a metric is no finite number
};

// What is recorded of one gyro.
struct Row {
    std::int64_t gyro = 0;
    Status status = Status::good;
    std::string reason;           // one line, at most max_reason bytes; empty where good
    std::string fingerprint;      // rig::Fingerprint of the run; empty where refused
    std::vector<double> metrics;  // in their order; NaN where there is none
};

inline constexpr std::size_t max_reason = 400;

// Equal in every bit.
[[nodiscard]] bool are_equal(const Row& a, const Row& b);

// Thrown out of a run that was asked to stop.
struct Stopped {};

class Gyros {
public:
    // errors  config::ConfigError of the base.
    explicit Gyros(const Description& description);

    [[nodiscard]] const Description& description() const { return description_; }
    [[nodiscard]] std::int64_t seed(std::int64_t gyro) const { return gyro_seed(description_, gyro); }
    [[nodiscard]] std::vector<Value> values(std::int64_t gyro) const { return draws_.values(gyro); }

    // errors  config::ConfigError where the drawn values are out of range or contradict each other.
    [[nodiscard]] config::Config config(std::int64_t gyro) const;

    // Runs twin and core of a gyro, by itself: from any thread, the same bits. Nothing is computed that no metric asks
    // for.
    //
    // is_stopped  looked at some hundred times in a run.
    // errors      Stopped; logs::IoError, logs::FormatError of a motion file, which must stay as it is. What is wrong
    // with the gyro is in its row.
    [[nodiscard]] Row run(std::int64_t gyro, const std::function<bool()>& is_stopped = {}) const;

    // The line of a shell that runs this gyro alone, with the same fingerprint.
    [[nodiscard]] std::string command(std::int64_t gyro) const;

private:
    Description description_;
    config::Config base_;
    Draws draws_;
    MotionWatch motion_files_;
    std::vector<std::string> variants_;  // that the metrics need
};

}  // namespace zlg::sweep
