#pragma once
// When the perimeter is at rest after a re-lock, from how the detuning decays.

#include <vector>

#include <zlg/calibration/lab_log.hpp>

namespace zlg::calibration {

// Mean detuning of each half over the re-locks, with the sign of the first half of each. Until it has fallen to noise,
// and half as long again: what is left is then well below the noise of the mean. A decay that outlasts the halves kept
// goes on as an exponential.
//
// return  settled_after_ticks or more; infinite where the detuning does not decay; settled_after_ticks where the column
//         detuning_lambda is missing or fewer than 4 re-locks are whole.
[[nodiscard]] double rest_after_ticks(const std::vector<Relock>& relocks);

}  // namespace zlg::calibration
