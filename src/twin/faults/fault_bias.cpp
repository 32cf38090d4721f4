#include "fault_bias.hpp"

#include <cmath>
#include <numbers>

#include "fault_plan.hpp"

namespace zlg::twin {
namespace {

// Integral of size sin^2(pi progress) from the start of the fault.
double turned_until_arcsec(const Fault& fault, double time_s) {
    const double part = progress(fault, time_s);
    const double swing = std::sin(2.0 * std::numbers::pi * part) / (2.0 * std::numbers::pi);
    return 0.5 * fault.size * fault.duration_s * (part - swing);
}

}  // namespace

double bias_ratio(std::span<const Fault> active, int bias_sign, double start_s, double end_s) {
    double ratio = 1.0;
    for (const Fault& fault : active) {
        if (fault.kind == FaultKind::bias_lost) ratio *= 1.0 - fault.size * share(fault, start_s, end_s);
        if (fault.kind == FaultKind::bias_asymmetric)
            ratio *= 1.0 + bias_sign * fault.size * share(fault, start_s, end_s);
    }
    return ratio;
}

double field_hz(std::span<const Fault> active, double start_s, double end_s) {
    double sum = 0.0;
    for (const Fault& fault : active) {
        if (fault.kind == FaultKind::field_pulse) sum += fault.size * share(fault, start_s, end_s);
    }
    return sum;
}

double turned_arcsec(std::span<const Fault> active, double start_s, double end_s) {
    double sum = 0.0;
    for (const Fault& fault : active) {
        if (fault.kind != FaultKind::overspeed) continue;
        sum += turned_until_arcsec(fault, end_s) - turned_until_arcsec(fault, start_s);
    }
    return sum;
}

}  // namespace zlg::twin
