#include "fault_plan.hpp"

#include <algorithm>
#include <map>

#include "fault_perimeter.hpp"

namespace zlg::twin {

// By a tree, for a sort is three kilobytes of the lab page's module.
FaultPlan::FaultPlan(const std::vector<Fault>& faults) {
    std::multimap<double, const Fault*> by_start;
    for (const Fault& fault : faults) by_start.emplace(fault.at_s, &fault);
    faults_.reserve(faults.size());
    for (const auto& [at_s, fault] : by_start) faults_.push_back(*fault);
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
