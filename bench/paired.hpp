#pragma once
// Ratios of the processor time of two pieces of work that are done in turn, so that a machine that slows down slows
// both, and one that does other work beside them is not waited for.

#include <algorithm>
#include <ctime>
#include <vector>

#include <fmt/format.h>

namespace zlg::bench {

template <class Work>
double seconds(Work&& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

inline double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Paired {
    double ratio = 0.0;  // median of work over reference
    double min_ratio = 0.0;
    double max_ratio = 0.0;
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
            .min_ratio = *std::min_element(ratios.begin(), ratios.end()),
            .max_ratio = *std::max_element(ratios.begin(), ratios.end()),
            .work_s = *std::min_element(works.begin(), works.end()),
            .reference_s = *std::min_element(references.begin(), references.end())};
}

}  // namespace zlg::bench
