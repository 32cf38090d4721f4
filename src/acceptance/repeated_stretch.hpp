#pragma once
// A record that holds a stretch of itself once more, as where a part of a file was appended to it.

#include <span>
#include <string>

namespace zlg::acceptance {

// In words, by the samples of the first such stretch of 256 or more, and of 4096 where neighbours are ever equal, as
// counts of a steady rotation repeat shorter ones; empty where there is none that chance would not make: at half the
// length one in a billion of all pairs would agree, were values independent and as often equal as neighbours are.
//
// values  NaN where nothing was measured; those are passed over.
[[nodiscard]] std::string repeated_stretch(std::span<const double> values);

}  // namespace zlg::acceptance
