#pragma once
// All constants that laboratory logs of one gyro determine, in the order in which they rest on each other.

#include <span>
#include <string>
#include <vector>

#include <zlg/calibration/drift_law.hpp>
#include <zlg/calibration/lab_log.hpp>
#include <zlg/calibration/loss_curve.hpp>
#include <zlg/numeric/estimate.hpp>

namespace zlg::calibration {

struct KnownFields {
    std::vector<FieldCourse> of_logs = {};  // of each; none: not known
    std::string why_none = "the field of a log is not known";
};

// What is known beforehand. Of the constants to be found it holds only those that are used where the data do not
// determine them.
struct Presumed {
    double scale_arcsec = 3.263;
    double reference_temperature_c = 20.0;
    double rate_arcsec_s = 0.0;                       // at which the gyro was turned
    bool read_by_slope = true;                        // all detunings were read by one and the same slope
    double bias_temperature_coefficient_per_c = 0.0;  // used where the logs hold a single temperature
    double half_wave_temperature_coefficient_per_c = 0.0;
    KnownFields field = {};
};

struct Constant {
    std::string key;   // of the configuration
    std::string unit;  // empty for a pure number
    numeric::Estimate estimate;
};

// How well a law fits: what the number is, and what it should be.
struct Goodness {
    std::string name;
    double value = 0.0;
    std::string meaning;
};

struct Calibration {
    std::vector<Constant> constants;
    std::vector<double> chi_higher = {};  // gyro.bias_chi_higher, with its bias_chi
    BiasTable bias_table = {};            // gyro.bias_temperature_table, beside its line
    std::vector<Goodness> goodness;
    LossCurve curve;  // where it is determined, bias_chi is found from logs that it has corrected
};

// logs    one or more of one gyro, of equal tick; otherwise std::invalid_argument.
// method  see the header of each law.
[[nodiscard]] Calibration calibrate(std::span<const LabLog> logs, const Presumed& presumed);

}  // namespace zlg::calibration
