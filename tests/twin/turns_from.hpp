#pragma once
// A phase of so many turns.

#include <zlg/twin/beat_phase.hpp>

namespace zlg::twin {

inline Turns turns(double t) {
    Turns result;
    result.add(t);
    return result;
}

}  // namespace zlg::twin
