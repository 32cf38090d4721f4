#include <zlg/deviations/angle_record.hpp>

#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <zlg/logs/long_column.hpp>

namespace zlg::deviations {
namespace {

// A sum of any length that is right to the last bit or two. A. Neumaier, ZAMM 54 (1974) 39: what an addition rounds off
// is kept beside the sum.
class LongSum {
public:
    void add(double value) {
        const double next = sum_ + value;
        lost_ += std::abs(sum_) >= std::abs(value) ? (sum_ - next) + value : (value - next) + sum_;
        sum_ = next;
    }
    [[nodiscard]] double value() const { return sum_ + lost_; }

private:
    double sum_ = 0.0;
    double lost_ = 0.0;
};

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

struct Known {
    std::int64_t n = 0;
    double mean = 0.0;
    bool constant = true;
};

// What is missing becomes NaN, so that one test finds it.
Known mark_missing(std::span<double> values, std::span<const std::uint8_t> valid) {
    Known known;
    double first = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (!std::isfinite(values[k]) || (!valid.empty() && valid[k] == 0)) {
            values[k] = missing;
            continue;
        }
        if (known.n++ == 0) first = values[k];
        // From the first: a sum of large equal numbers would lose what they differ by.
        sum += values[k] - first;
        known.constant = known.constant && values[k] == first;
    }
    if (known.n > 0) known.mean = first + sum / static_cast<double>(known.n);
    return known;
}

}  // namespace

AngleRecord::AngleRecord(const Series& series) : what_(series.what) {
    check(series);
    angle_.reserve(series.values.size() + 1);
    angle_.assign(series.values.begin(), series.values.end());
    build(series.valid);
}

AngleRecord::AngleRecord(const SeriesKind& what, std::vector<double>&& values, std::span<const std::uint8_t> valid)
    : what_(what), angle_(std::move(values)) {
    check(Series{.what = what, .values = angle_, .valid = valid});
    build(valid);
}

void AngleRecord::build(std::span<const std::uint8_t> valid) {
    n_samples_ = static_cast<std::int64_t>(angle_.size());
    const auto known = mark_missing(angle_, valid);
    n_known_ = known.n;
    if (known.n == 0) throw SeriesError(fmt::format("record: none of its {} samples is valid", n_samples_));
    if (known.constant && known.n > 1)
        throw SeriesError(fmt::format("record: all {} valid samples are {}, a deviation needs some that differ",
                                      known.n, known.mean));
    if (what_.kind == DataKind::phase) return;
    if (n_samples_ > std::numeric_limits<std::int32_t>::max() && has_gaps())
        throw SeriesError("record: with gaps at most 2^31 samples");
    angle_.push_back(missing);
    if (has_gaps()) known_.assign(angle_.size(), 0);
    LongSum sum;
    std::uint32_t count = 0;
    for (std::size_t k = 0; k < angle_.size(); ++k) {
        const double value = angle_[k];
        angle_[k] = sum.value();
        if (!known_.empty()) known_[k] = count;
        if (!std::isfinite(value)) continue;
        sum.add(value - known.mean);
        ++count;
    }
}

void use_in_place(std::vector<double>& rates, double rate_hz, const std::function<void(const AngleRecord&)>& use) {
    logs::LongColumn kept;
    for (const double rate : rates) kept.push_back(rate);
    std::exception_ptr error;
    try {
        use(AngleRecord({DataKind::rate, Unit::arcsec_s, rate_hz}, std::move(rates)));
    } catch (...) {
        error = std::current_exception();
    }
    rates = kept.vector();
    if (error) std::rethrow_exception(error);
}

}  // namespace zlg::deviations
