#pragma once
// The averaged gyro: the bias counts as its mean, the light as a straight discriminator.

#include <zlg/twin/motion.hpp>

#include "fringe_counter.hpp"
#include "fringe_photodiodes.hpp"
#include "gyro.hpp"
#include "housing.hpp"
#include "laser/bias_area.hpp"
#include "noise.hpp"
#include "perimeter/perimeter_course.hpp"
#include "photodiodes.hpp"

namespace zlg::twin {

class AveragedGyro final : public Gyro {
public:
    // config  validated.
    AveragedGyro(const TwinConfig& config, Motion motion);

    const TwinHalf& advance(const core::ActuatorFrame& actuator) override;

    std::int64_t quiet_halves() override;
    std::int64_t even_halves() override;
    double voltage_after(std::int64_t halves) override { return housing_.voltage_after(halves); }
    Leap leap(std::int64_t halves, const LeapWay& way) override;

private:
    struct Drifts;
    [[nodiscard]] double magnetic_arcsec_s(double start_s, double end_s) const;
    void pass_singly(const Drifts& drifts, Leap& made);
    void pass_over(const Drifts& drifts, Leap& made);
    void add_detuning_noise(const Drifts& drifts, const DetuningNoise& noise, Leap& made);
    [[nodiscard]] bool is_lit_in_one_mode() const;  // throughout the half
    void take_light(int bias_sign, bool is_steady, core::SensorFrame& sensor);
    BiasArea bias_area(bool is_steady, TwinTruth& truth);
    void add_pieces(BiasArea& area, TwinTruth& truth);
    void count(const BiasArea& area, int bias_sign, TwinHalf& half);
    void see_fringe(int bias_sign, TwinHalf& half);
    [[nodiscard]] double bias_hz() const { return config_.gyro.bias_hz * housing_.bias_growth(); }
    [[nodiscard]] double plateau_hz() const;

    TwinConfig config_;
    bool can_leap_;
    Motion motion_;
    double plateau_over_mean_;    // the bias between its reversals over its mean
    double walk_of_half_arcsec_;  // standard deviation
    Housing housing_;
    PerimeterCourse course_;
    Photodiodes photodiodes_;
    FringePhotodiodes fringe_photodiodes_;
    NoiseAhead<1> walk_noise_;
    Noise dark_noise_;
    FringeCounter counter_;
    double garbage_cycles_ = 0.0;
    TwinHalf half_{};
};

}  // namespace zlg::twin
