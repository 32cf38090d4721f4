#pragma once
// Descriptions of sweeps for the tests.

#include <zlg/sweep/description.hpp>

#include "test.hpp"

inline const std::string testing_metric = "[[metric]]\nname = \"configured.switch_error_rms_arcsec\"\n";

// One parameter of each draw; 16 gyros.
inline const std::string every_draw = R"(
sweep = {gyros = 16, seed = 5, duration_s = 6}
base = {switching = {interval_s = 2}, compensation = {relock = "mean_square"}}
parameter = [
    {keys = ["gyro.light_samples"], draw = "grid", values = [8, 16]},
    {keys = ["compensation.bridge"], draw = "list", values = ["quadratic", "auto", "linear"]},
    {keys = ["gyro.bias_chi"], draw = "uniform", min = 3.4, max = 3.8},
    {keys = ["gyro.light_noise_lambda"], draw = "log_uniform", min = 0.001, max = 0.1},
    {keys = ["piezo.half_wave_v"], draw = "normal", mean = 40, sd = 0.5},
    {keys = ["drift.magnetic_arcsec_s",
             "compensation.magnetic_arcsec_s"], draw = "truncated", mean = 0.7, sd = 0.2, min = 0.5, max = 1},
    {keys = ["perimeter.miss_lambda"], draw = "latin", min = 0.1, max = 0.2},
    {keys = ["drift.nonmagnetic_arcsec_s"], draw = "sobol", min = 0, max = 1},
]
metric = [
    {name = "configured.switch_error_rms_arcsec", max = 3},
    {name = "one_mode.drift_arcsec_s"},
    {name = "switches", min = 1},
]
)";

// A few gyros of a few seconds.
inline zlg::sweep::Description short_sweep(int gyros = 6) {
    return zlg::sweep::parse("[sweep]\nseed = 11\nduration_s = 5\ngyros = " + std::to_string(gyros) +
                                 "\n[base.switching]\ninterval_s = 2\n[[parameter]]\nkeys = [\"gyro.bias_chi\"]\n"
                                 "draw = \"uniform\"\nmin = 3.4\nmax = 3.8\n" +
                                 testing_metric,
                             "short");
}
