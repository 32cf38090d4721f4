#pragma once
// A record that holds a stretch of itself once more, as where a part of a file was appended to it.

#include <span>
#include <string>

namespace zlg::acceptance {

// In words, by the samples of the first such stretch; empty where there is none that chance would not make: of so many
// pairs of stretches one in a billion, were the values of each independent with the spread that those of 64 neighbours
// have, at half the length.
//
// values  NaN where nothing was measured; those are passed over.
[[nodiscard]] std::string repeated_stretch(std::span<const double> values);

}  // namespace zlg::acceptance
