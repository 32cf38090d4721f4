#pragma once
// Scale of the detuning signal: logged wavelengths per true wavelength.
//
//   g = <dl_logged dl_piezo>/<dl_piezo^2>,   dl_piezo = (U - U_settled)/(2 U_lambda/2)
//
// The piezo is the ruler: half a wavelength is what separates two modes. chi and f0 alone do not determine g, for the
// loss of bias fixes only chi g^-2. Mean detunings of the halves of a transient are compared with the mean travel,
// which follows from the voltages at the borders: where it is smooth (an analog loop) by a cubic through four of them,
// where it is commanded half by half (a digital loop) as a mean of two with unknown weights.

#include <cstdint>
#include <span>

#include <zlg/calibration/half_wave_law.hpp>
#include <zlg/calibration/lab_log.hpp>
#include <zlg/numeric/estimate.hpp>

namespace zlg::calibration {

struct DetuningScale {
    numeric::Estimate scale;
    std::int64_t n_relocks = 0;
    double scatter_lambda = 0.0;  // rms of a half's mean detuning about the law
};

[[nodiscard]] DetuningScale find_detuning_scale(std::span<const LabLog> logs, const HalfWaveLaw& law,
                                                bool stepped_voltage);

}  // namespace zlg::calibration
