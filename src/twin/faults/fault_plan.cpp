#include "fault_plan.hpp"

#include <algorithm>

#include "fault_perimeter.hpp"

namespace zlg::twin {

// There are few: they are put in their places, for a sort is three kilobytes of the lab page's module.
FaultPlan::FaultPlan(const std::vector<Fault>& faults) {
    const auto earlier = [](const Fault& a, const Fault& b) { return a.at_s < b.at_s; };
    for (const Fault& fault : faults)
        faults_.insert(std::upper_bound(faults_.begin(), faults_.end(), fault, earlier), fault);
    active_.reserve(faults_.size());
}

void FaultPlan::enter(double start_s, double end_s) {
    while (next_ < faults_.size() && faults_[next_].at_s <= end_s) active_.push_back(faults_[next_++]);
    std::erase_if(active_, [&](const Fault& fault) {
        const bool over = fault.at_s + fault.duration_s <= start_s;
        if (over) settle(fault);
        return over;
    });
    const auto any_on = [&](FaultActs thing) {
        return std::any_of(active_.begin(), active_.end(),
                           [&](const Fault& fault) { return facts(fault.kind).acts_on == thing; });
    };
    moves_perimeter_ = settled_lambda_ != 0.0 || any_on(FaultActs::length);
    dims_light_ = any_on(FaultActs::light);
}

void FaultPlan::settle(const Fault& fault) {
    const double end_s = fault.at_s + fault.duration_s;
    if (facts(fault.kind).acts_on == FaultActs::length) settled_lambda_ += length_lambda(fault, end_s, 0.0);
    if (fault.kind == FaultKind::thermal_shock) settled_c_ += fault.size;
}

double share(const Fault& fault, double start_s, double end_s) {
    const double from_s = std::max(start_s, fault.at_s);
    const double to_s = std::min(end_s, fault.at_s + fault.duration_s);
    return to_s > from_s ? (to_s - from_s) / (end_s - start_s) : 0.0;
}

}  // namespace zlg::twin
