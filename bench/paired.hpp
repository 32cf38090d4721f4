#pragma once
// Ratios of two pieces of work that are timed in turn, so that a machine that slows down slows both.

#include <algorithm>
#include <chrono>
#include <vector>

#include <fmt/format.h>

namespace zlg::bench {

template <class Work>
double seconds(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Paired {
    double ratio = 0.0;  // median of work over reference
    double least_ratio = 0.0;
    double most_ratio = 0.0;
    double work_s = 0.0;  // least
    double reference_s = 0.0;
};

// One pair to warm up, then `n` that count.
template <class Work, class Reference>
Paired paired(int n, Work&& work, Reference&& reference) {
    std::vector<double> ratios;
    std::vector<double> works;
    std::vector<double> references;
    for (int k = 0; k <= n; ++k) {
        const double reference_s = seconds(reference);
        const double work_s = seconds(work);
        if (k == 0) continue;
        ratios.push_back(work_s / reference_s);
        works.push_back(work_s);
        references.push_back(reference_s);
    }
    return {.ratio = median(ratios),
            .least_ratio = *std::min_element(ratios.begin(), ratios.end()),
            .most_ratio = *std::max_element(ratios.begin(), ratios.end()),
            .work_s = *std::min_element(works.begin(), works.end()),
            .reference_s = *std::min_element(references.begin(), references.end())};
}

}  // namespace zlg::bench
