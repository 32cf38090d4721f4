#pragma once
// Scale factor and bias from a rate table, by the test procedure of IEEE Std 647.
//
//   output_j = K input_j + D + error_j       straight line by least squares over the stages
//
// A stage is a stretch in which the table turned at one rate; its first samples, while it settles, are left out.

#include <cstdint>
#include <span>
#include <vector>

#include <zlg/numeric/estimate.hpp>

namespace zlg::calibration {

struct TableStage {
    double input_arcsec_s = 0.0;  // mean of the table
    double output = 0.0;          // mean of the gyro, units a second
    double output_sigma = 0.0;    // of that mean, from its scatter over tenths of the stage
    std::int64_t n_samples = 0;
    double residual_ppm = 0.0;  // output less the line, of K times the largest input
};

struct RateTable {
    std::vector<TableStage> stages;
    numeric::Estimate scale_factor;     // K, units of the output per arcsec
    numeric::Estimate arcsec_per_unit;  // 1/K
    numeric::Estimate bias_arcsec_s;    // D/K
    numeric::Estimate asymmetry_ppm;    // (K+ - K-)/mean, lines through positive and negative inputs, each with zero
    double nonlinearity_ppm = 0.0;      // rms of the residuals
    double largest_residual_ppm = 0.0;
    std::vector<std::size_t> far;      // stages that the line through the others misses by more than 8 of its errors
    double hysteresis_arcsec_s = 0.0;  // largest difference between stages of equal input, over K
};

struct RateTableOptions {
    double same_rate_ratio = 1e-4;  // samples of the table this near, of its largest rate, are of one stage or input
    std::int64_t settling_samples = 0;  // at the beginning of each stage
    std::int64_t min_samples = 20;      // of a stage; shorter ones are passages
    double earth_arcsec_s = 0.0;        // known rotation about the axis that the table does not show
};

// input_arcsec_s  of the table; NaN: not known, as output where the gyro did not measure. Such samples count nowhere
//                 and end no stage.
// output          of the gyro over each sample, units a second (counts a second, or arcsec/s).
//
// errors  SeriesError: lengths differ, fewer than 3 stages, all of one rate.
[[nodiscard]] RateTable rate_table(std::span<const double> input_arcsec_s, std::span<const double> output,
                                   const RateTableOptions& options = {});

}  // namespace zlg::calibration
