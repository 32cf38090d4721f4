"""Noise of a gyro from its readings: Allan deviation and its kin, noise terms, drift by mode, rate tables, spectra.

What the numbers are is always said: `data_type` is "increments" (angle turned in each interval), "rate" (mean over each interval) or
"phase" (angle at the borders of the intervals, one more), and has no default. NaN, or valid == False, is a missing sample: it is neither
filled nor closed up.

`deviation` knows units and intervals. `adev` ... `htotdev` have the signature that users of other tools know.
"""

from ._deviations import (
    adev,
    deviation,
    Deviations,
    deviations_of_log,
    DeviationStream,
    hdev,
    htotdev,
    KINDS,
    mdev,
    mtotdev,
    oadev,
    ohdev,
    tdev,
    totdev,
)
from ._noise import (
    data_sheet,
    discrete_noise,
    DiscreteNoise,
    fit_noise,
    FittedTerm,
    imu_yaml,
    ModeSplit,
    NoiseFit,
    rate_table,
    RateTable,
    read_imu_yaml,
    spectrogram,
    split_modes,
    terms_of_data_sheet,
    welch_spectrum,
)
from ._zlg import NoiseTerms

__all__ = [
    "Deviations",
    "DeviationStream",
    "DiscreteNoise",
    "FittedTerm",
    "KINDS",
    "ModeSplit",
    "NoiseFit",
    "NoiseTerms",
    "RateTable",
    "adev",
    "data_sheet",
    "deviation",
    "deviations_of_log",
    "discrete_noise",
    "fit_noise",
    "hdev",
    "htotdev",
    "imu_yaml",
    "mdev",
    "mtotdev",
    "oadev",
    "ohdev",
    "rate_table",
    "read_imu_yaml",
    "spectrogram",
    "split_modes",
    "tdev",
    "terms_of_data_sheet",
    "totdev",
    "welch_spectrum",
]
