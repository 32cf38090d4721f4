#pragma once
// The law that an estimated variance follows.

#include <memory>
#include <vector>

namespace zlg::deviations {

// scale chi2(dof)
struct ChiSquarePart {
    double scale = 1.0;
    double dof = 1.0;
};

// The law of an estimated variance over its expectation.
//
// Few terms, strongly correlated, are a sum of a few squares of unequal weight: `parts`, the eigenvalues of their
// covariance, are the law itself. Of many terms mean, variance and skewness are enough. Of the chi-square law p = edf;
// a sum of squares that are correlated is more skew, p < edf.
struct VarianceLaw {
    double edf = 1.0;                                           // equivalent degrees of freedom 2 <V>^2/var V
    double skewness_p = 1.0;                                    // 8/skewness^2
    std::shared_ptr<const std::vector<ChiSquarePart>> parts{};  // of the mean 1; none: by the moments
};

}  // namespace zlg::deviations
