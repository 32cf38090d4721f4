#pragma once
// What the values of a log must be, and the words in which its readers and writers complain of others.
//
// A rule judges a value and the number of its row, from 0: `allows(value, row)`. Of a value that it does not allow,
// `fault(value, row)` ends a message that begins with the value. Rules of whole numbers have `allowed()` besides, for a
// text that is no whole number at all.

#include <cstdint>
#include <limits>
#include <string>

#include <zlg/core/records.hpp>

namespace zlg::logs {

// Rows are counted from 0 without holes.
struct RowNumber {
    static constexpr bool allows(std::int64_t value, std::int64_t row) { return value == row; }
    static std::string fault(std::int64_t value, std::int64_t row);
    static std::string allowed();
};

// +1 or -1.
struct Sign {
    template <class T> static constexpr bool allows(T value, std::int64_t) { return (value == 1) | (value == -1); }
    static std::string fault(std::int64_t value, std::int64_t row);
    static std::string allowed();
};

// 0 or 1.
struct Flag {
    template <class T> static constexpr bool allows(T value, std::int64_t) { return (value == 0) | (value == 1); }
    static std::string fault(std::int64_t value, std::int64_t row);
    static std::string allowed();
};

// A whole number within bounds.
struct Whole {
    std::int64_t min;
    std::int64_t max;

    [[nodiscard]] constexpr bool allows(std::int64_t value, std::int64_t) const {
        return (value >= min) & (value <= max);
    }
    [[nodiscard]] std::string fault(std::int64_t value, std::int64_t row) const;
    [[nodiscard]] std::string allowed() const;
};

// Any number that a T holds.
template <class T> inline constexpr Whole any_whole{std::numeric_limits<T>::min(), std::numeric_limits<T>::max()};

// A finite number within bounds; the bitwise operators let a loop over a column be vectorised.
struct Real {
    double min = std::numeric_limits<double>::lowest();
    double max = std::numeric_limits<double>::max();
    const char* unit = "";  // of the bounds, in messages

    [[nodiscard]] constexpr bool allows(double value, std::int64_t) const { return (value >= min) & (value <= max); }
    static std::string allowed();
    [[nodiscard]] std::string fault(double value, std::int64_t row) const;
};

// A place within a count, 1/65536: a whole number, NaN where it is not known.
struct Fringe {
    static constexpr std::int64_t max = core::count_parts - 1;

    static constexpr bool allows(double value, std::int64_t) {
        const bool is_within = (value >= 0.0) & (value <= static_cast<double>(max));
        const auto whole = static_cast<std::int32_t>(is_within ? value : 0.0);
        return (value != value) | (is_within & (static_cast<double>(whole) == value));
    }
    static std::string allowed();
    static std::string fault(double value, std::int64_t row);
};

// A light sample: a finite number, or NaN where the converter gave none.
struct Sample {
    static constexpr bool allows(double value, std::int64_t row) {
        return (value != value) | Real{}.allows(value, row);
    }
    static std::string allowed();
    static std::string fault(double value, std::int64_t row);
};

// A standard deviation: 0 or more, inf where it is not known.
struct Deviation {
    static constexpr bool allows(double value, std::int64_t) { return value >= 0.0; }
    static std::string allowed();
    static std::string fault(double value, std::int64_t row);
};

// What the rows before it allow a row of a raw log: the bias sign alternates, and a span goes over no more rows than
// those directly before it with valid 0, counts 0 and span 1.
class RawSequence {
public:
    struct Fault {
        const char* column;
        std::int64_t value;
        std::string what;
    };

    // True: the row may follow, and counts as one of those before from now on.
    [[nodiscard]] bool next(const core::HalfRecord& r) {
        if (r.bias_sign == bias_sign_ || r.span < 1 || r.span - 1 > n_missed_) return false;
        bias_sign_ = r.bias_sign;
        n_missed_ = !r.valid && r.counts == 0 && r.span == 1 ? n_missed_ + 1 : 0;
        return true;
    }

    // What is wrong with a row that may not follow.
    [[nodiscard]] Fault fault(const core::HalfRecord& record) const;

private:
    std::int8_t bias_sign_ = 0;
    std::int64_t n_missed_ = 0;
};

}  // namespace zlg::logs
