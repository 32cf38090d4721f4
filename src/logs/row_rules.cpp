#include <zlg/logs/row_rules.hpp>

#include <fmt/format.h>

#include <cmath>

namespace zlg::logs {

namespace {

std::string out_of_range(const std::string& allowed) { return "is out of range; allowed is " + allowed; }

}  // namespace

std::string RowNumber::allowed() { return Whole{0, std::numeric_limits<std::int64_t>::max()}.allowed(); }
std::string RowNumber::fault(std::int64_t value, std::int64_t row) {
    if (value < 0) return out_of_range(allowed());
    if (row == 0)
        return "leaves a hole; expected 0, where the numbers of every log begin: number the rows of one that was cut "
               "out of a longer log anew; a raw log must be cut at an even half-period";
    return fmt::format("{}; expected {}", value > row ? "leaves a hole" : "is a repetition", row);
}

std::string Sign::allowed() { return "+1 or -1"; }
std::string Sign::fault(std::int64_t, std::int64_t) { return out_of_range(allowed()); }

std::string Flag::allowed() { return "0 or 1"; }
std::string Flag::fault(std::int64_t, std::int64_t) { return out_of_range(allowed()); }

std::string Whole::allowed() const { return fmt::format("{}..{}", min, max); }
std::string Whole::fault(std::int64_t, std::int64_t) const { return out_of_range(allowed()); }

std::string Real::allowed() { return "a finite number"; }
std::string Real::fault(double value, std::int64_t) const {
    if (!std::isfinite(value)) return "is not finite; allowed is " + allowed();
    return out_of_range(fmt::format("{:g}..{:g} {}", min, max, unit));
}

std::string Fringe::allowed() { return fmt::format("{}, or nan where it is not known", Whole{0, max}.allowed()); }
std::string Fringe::fault(double, std::int64_t) { return out_of_range(allowed()); }

std::string Sample::allowed() { return "a finite number, or nan where the converter gave none"; }
std::string Sample::fault(double, std::int64_t) { return out_of_range(allowed()); }

std::string Deviation::allowed() { return "a number or inf"; }
std::string Deviation::fault(double value, std::int64_t) {
    return std::isnan(value) ? "is not a number; allowed is " + allowed() : "is negative; allowed is 0 or more, or inf";
}

RawSequence::Fault RawSequence::fault(const core::HalfRecord& r) const {
    if (r.bias_sign == bias_sign_)
        return {"bias_sign", r.bias_sign,
                fmt::format("as in the row before; expected {:+d}: it must alternate", -r.bias_sign)};
    return {"span", r.span,
            fmt::format("is out of range; allowed is 1..{}: this row and the {} directly before it with valid 0, "
                        "counts 0, span 1",
                        n_missed_ + 1, n_missed_)};
}

}  // namespace zlg::logs
