#pragma once
// The count and the place within it as the electronics read them: whole, or by two photodiodes whose ellipse the core
// corrects.
//
//   c = o_c + cos 2 pi p,  s = o_s + (1 + e) sin(2 pi p + d)          white noise in each, then a converter for +-2
//
// The counter is floor(p), its comparators stand in the quarter floor(4 p). Latch and sampling are the same moment.

#include <cstdint>

#include <zlg/chance/draw.hpp>
#include <zlg/core/control/fringe_readout.hpp>
#include <zlg/core/records.hpp>

#include "laws.hpp"

namespace zlg::trials {

struct FringeReading {
    std::int64_t counts = 0;            // since the reading before
    float fringe = __builtin_nanf("");  // place within the count, 0..65535; NaN: not known
};

class FringeReader {
public:
    FringeReader(const PhotodiodeLaw& law, double phase_counts);

    // Twenty seconds of a settled gyro that turns, before the first reading.
    void learn(chance::Draw& draw);

    // The reading at the end of a half.
    //
    // sign     of the beat in this half.
    // settled  the beat is steady since some halves.
    FringeReading read(double phase_counts, int sign, bool settled, chance::Draw& draw);

    // The same of a half without a beat: nothing is known of the fringe.
    void lose(double phase_counts, chance::Draw& draw);

    // The latest reading, in counts as the compensation takes it: whole ones as they are; with photodiodes the place
    // within the count, or its middle where that is not known.
    [[nodiscard]] double reading_counts() const { return reading_counts_; }

private:
    [[nodiscard]] double converted(double value) const;
    core::FringeReadoutInput sample(double phase_counts, chance::Draw& draw) const;

    PhotodiodeLaw law_;
    core::FringeReadoutConfig config_;
    core::FringeReadoutState state_;
    std::int64_t counter_;
    double reading_counts_;
};

}  // namespace zlg::trials
