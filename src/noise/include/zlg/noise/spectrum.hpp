#pragma once
// The spectrum of a rate with gaps, averaged over the record.
//
// Each piece is freed of the mean of what is known in it and weighted by a Hann window; a missing sample weighs nothing
// and the sum of the squared weights that are left is the scale. Gaps are neither filled nor cut out, so that
// frequencies stay where they are; what leaks is that of the window with holes.

#include <cstddef>
#include <span>
#include <vector>

namespace zlg::noise {

struct Spectrum {
    std::vector<double> frequency_hz;  // from one step to half the rate
    std::vector<double> density;       // one-sided, (arcsec/s)^2/Hz
    std::size_t pieces = 0;            // that were averaged
};

// Welch's: pieces overlap by half; one of which less than least_known_ratio is known is left out.
//
// piece   samples; at most the record's length is used.
// errors  SeriesError: rate not positive, piece below 8, no piece known well enough.
[[nodiscard]] Spectrum welch_spectrum(std::span<const double> rates_arcsec_s, double rate_hz, std::size_t piece,
                                      double least_known_ratio = 0.5);

}  // namespace zlg::noise
