#pragma once
// The digital twin: a Zeeman laser gyro, one half-period at a time.
//
// It obeys actuator frames and answers with sensor frames, and tells beside them the truth that no gyro knows. How much
// physics lies between the two is its fidelity; the interface is the same.

#include <cstdint>
#include <memory>

#include <zlg/core/records.hpp>
#include <zlg/twin/leap.hpp>
#include <zlg/twin/motion.hpp>
#include <zlg/twin/twin_config.hpp>
#include <zlg/twin/twin_half.hpp>

namespace zlg::twin {

class Gyro;

class Twin {
public:
    // errors  std::invalid_argument with the offending member's name and value; std::runtime_error for a laser that has
    //         no light both ways at its centre, or whose table cannot be made good.
    // cost    of `laser` 50 ms to 200 ms and some MB, for its table.
    Twin(const TwinConfig& config, Motion motion);
    ~Twin();
    Twin(Twin&&) noexcept;
    Twin& operator=(Twin&&) noexcept;

    // Live through the next half-period under `actuator`. The loop counts as closed before the first one.
    //
    // edge_offset_ticks shifts the reversal that ends this half, in ticks of 0.1 us, positive is later; the counter is
    // latched at the shifted reversal, and the stamp tells when. Only `laser` obeys: the averaged model has no phases
    // for it to act on. Everything else, the truth included, stays on the grid of equal halves. errors
    // std::invalid_argument for a frame that hardware could not obey; std::overflow_error where a half brings
    //         more fringes than 64 bits tell.
    // return  until the next call.
    // cost    about 0.3 us with 16 light samples, of `laser` about 2.7 us; no allocation.
    const TwinHalf& advance(const core::ActuatorFrame& actuator);

    // Halves from here on that may be leapt over where the loop has settled: of an averaged gyro those before the next
    // fault; 0 of a laser, and of a gyro whose halves follow no closed law.
    [[nodiscard]] std::int64_t quiet_halves();
    // Of these, those before the magnetic field steps: the drift of a leap is even.
    [[nodiscard]] std::int64_t even_halves();
    // Of the piezo, when so many quiet halves have passed. It changes in one direction only.
    [[nodiscard]] double voltage_after(std::int64_t halves);
    // Pass over so many quiet and even halves, an even number.
    Leap leap(std::int64_t halves, const LeapWay& way = {});

private:
    std::unique_ptr<Gyro> gyro_;
};

}  // namespace zlg::twin
