#include "fourier.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <unsupported/Eigen/FFT>
#pragma GCC diagnostic pop

namespace zlg::noise {

std::size_t quick_length(std::size_t n) {
    for (;; ++n) {
        std::size_t rest = n;
        for (const std::size_t prime : {2u, 3u, 5u})
            while (rest % prime == 0 && rest > 1) rest /= prime;
        if (rest <= 1) return n;
    }
}

std::vector<std::complex<double>> half_spectrum(const std::vector<double>& values) {
    Eigen::FFT<double> transform;
    transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    std::vector<std::complex<double>> spectrum;
    transform.fwd(spectrum, values);
    return spectrum;
}

}  // namespace zlg::noise
