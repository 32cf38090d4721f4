#pragma once
// Labels of round numbers, held as n * 10^exponent so that no digit of a label comes from binary rounding.

#include <string>
#include <vector>

namespace zlg::report {

struct Decimal {
    long long n = 0;
    int exponent = 0;
};

[[nodiscard]] double value_of(Decimal decimal);

// Every digit written out, thousands parted from five digits on.
[[nodiscard]] std::string plain_label(Decimal decimal);

// 10 to the power, with superscript digits.
[[nodiscard]] std::string power_label(int exponent);

// Labels of the marks of one axis, all in one form: plain, or with a common power of ten where that is shorter.
[[nodiscard]] std::vector<std::string> labels_of(const std::vector<Decimal>& decimals);

}  // namespace zlg::report
