#pragma once
// The beats of both helicities on one pair of detectors, and the counter behind it.
//
// The counter counts turns of the sum z = A_L exp(i psi_L) + A_R exp(i psi_R). While A_L > A_R,
//
//   arg z = psi_L + arg[1 + (A_R/A_L) exp(i (psi_R - psi_L))]
//
// and the second term cannot leave +-asin(A_R/A_L): the sum turns as often as its larger part, exactly, and the smaller
// one only ripples the count. Where the larger becomes the smaller the sum goes on from where it is, so each exchange
// adds what the difference of the phases happens to be at that moment. When the parts are nearly equal the sum passes
// so near zero that the comparators miss turns; there the decoder is run sample by sample.

#include <zlg/twin/beat_phase.hpp>
#include <zlg/twin/quadrature.hpp>

namespace zlg::twin {

// One helicity over a stretch of time.
struct Beat {
    double start_hz = 0.0;  // drive: rotation, bias and drift; linear from start to end
    double end_hz = 0.0;
    Coupling coupling{};
    double amplitude = 0.0;  // 2 sqrt(I_cw I_ccw); 0: not two-way, the phase rests
};

class OpticalBeats {
public:
    // threshold  of the comparators, unit of the amplitudes, >= 0.
    OpticalBeats(double threshold, const Turns& left, const Turns& right);

    // Live through a stretch. Amplitudes jump at its start, which counts as the shortest way from sum to sum.
    //
    // The count is right at the end of the stretch; what lies within is followed from turning point to turning point.
    // cost  that of `BeatPhase::advance` for each lit beat and about 0.1 us; nearly equal beats 30 ns per 1/16 turn.
    void advance(const Beat& left, const Beat& right, double duration_s);

    // Both phases are moved at once.
    void kick(double left_turns, double right_turns);

    // The counter as latched now, free-running: quarters of a turn, or whole turns.
    [[nodiscard]] std::uint64_t latch_quarters() const;
    [[nodiscard]] std::uint64_t latch_turns() const;

    [[nodiscard]] const Turns& left() const { return left_.value(); }
    [[nodiscard]] const Turns& right() const { return right_.value(); }
    [[nodiscard]] const Turns& winding() const { return winding_; }  // unwrapped phase of the sum
    [[nodiscard]] Signals signals() const;

private:
    void set_amplitudes(double left, double right);
    void live_monotone(const Beat& left, const Beat& right, double duration_s);
    void sample_sum(const Beat& left, const Beat& right, const Turns& left_before, const Turns& right_before,
                    double duration_s);
    void follow(const Turns& phase);
    [[nodiscard]] double beside_larger() const;
    [[nodiscard]] double size() const;  // of the sum

    double threshold_;
    BeatPhase left_;
    BeatPhase right_;
    double left_amplitude_ = 0.0;
    double right_amplitude_ = 0.0;
    Turns winding_;
    QuarterTurns count_;
    double lag_size_ = 0.0;  // the size of the sum for which lag_turns_ was computed
    double lag_turns_ = 0.0;
    std::uint64_t missed_ = 0;  // counter minus quarters of the winding: what near-equal beats have left behind
};

}  // namespace zlg::twin
