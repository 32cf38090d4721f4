#pragma once
// The gyro as a laser: light, discriminator, bias and random walk follow from gas, mirrors and field.

#include <array>
#include <cstdint>
#include <memory>

#include <zlg/twin/laser_table.hpp>
#include <zlg/twin/motion.hpp>

#include "fringe_photodiodes.hpp"
#include "gyro.hpp"
#include "housing.hpp"
#include "laser/bias_half.hpp"
#include "laser/error_signal.hpp"
#include "laser/laser_beats.hpp"
#include "noise.hpp"
#include "perimeter/perimeter_course.hpp"

namespace zlg::twin {

class LaserGyro final : public Gyro {
public:
    // config  validated.
    // errors  std::runtime_error as averaged_laser and LaserTable.
    LaserGyro(const TwinConfig& config, Motion motion);

    const TwinHalf& advance(const core::ActuatorFrame& actuator) override;

private:
    static constexpr std::size_t n_edge_pieces = 4;  // of the half of a reversal that lies in one half-period

    // Bias without detuning, positive helicity and field: the truth tells what detuning makes of it.
    struct Reference {
        double plateau_g = 0.0;
        double plateau_hz = 0.0;
        double whole_edge_hz = 0.0;
        double slip_rad = 0.0;  // of a reversal, and what the bias departs from a chord by
        double bend_rad = 0.0;
        std::array<double, n_edge_pieces> edge_hz{};  // from zero field outwards
    };

    [[nodiscard]] BiasHalf enter(const core::ActuatorFrame& actuator);
    void take_light(const BiasHalf& bias, core::SensorFrame& sensor);
    void live_through_half(const BiasHalf& bias, TwinTruth& truth);
    void see_fringe(TwinHalf& half);
    [[nodiscard]] bool edge_is_calm(double at_s, double plateau_g) const;
    void live_edge(const BiasHalf& bias, bool rising, TwinTruth& truth);
    void live_plateau(const BiasHalf& bias, TwinTruth& truth);
    void account(const Followed& followed, double reference_hz, double duration_s, TwinTruth& truth);
    void take_reference(double plateau_g);
    // But for its field.
    [[nodiscard]] Stretch stretch(double from_s, double duration_s, double drive_hz) const;
    [[nodiscard]] double common_hz(double from_s, double to_s) const;
    [[nodiscard]] double turned_arcsec(double from_s, double to_s) const;  // by the case

    TwinConfig config_;
    Motion motion_;
    double fringe_arcsec_;  // per turn of a beat
    LaserTable table_;
    std::shared_ptr<const ErrorSignal> signal_;
    Housing housing_;
    PerimeterCourse course_;
    LaserBeats beats_;
    FringePhotodiodes fringe_photodiodes_;
    Reference reference_;
    double light_noise_;
    Noise light_stream_;
    NoiseAhead<2> quantum_noise_;
    double rotation_hz_ = 0.0;       // mean beat of the rotation in the half
    std::int32_t offset_ticks_ = 0;  // of the reversal that began the half
    int followed_ = 0;               // helicity that the counter follows
    TwinHalf half_{};
};

}  // namespace zlg::twin
