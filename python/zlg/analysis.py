"""Noise of a gyro from its readings: Allan deviation and its kin, noise terms, drift by mode, rate tables, spectra.

What the numbers are is always said: `data_type` is "increments" (angle turned in each interval), "rate" (mean over each interval) or
"phase" (angle at the borders of the intervals, one more), and has no default. NaN, or valid == False, is a missing sample: it is neither
filled nor closed up.

`deviation` knows units and intervals. `adev` ... `totdev` have the signature that users of other tools know.
"""

from . import _deviations, _noise
from ._deviations import *
from ._noise import *

__all__: list[str] = []
__all__ += _deviations.__all__
__all__ += _noise.__all__
