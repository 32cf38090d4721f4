"""The sections of a configuration as dataclasses.

Made by tools/python_configuration from the table of keys; do not edit.
"""

from dataclasses import dataclass, field
from typing import Literal, Optional, Union

from .section import Section

FaultsKind = Literal[
    "laser_off", "beam_fades", "mode_hop", "switch_wrong_mode", "switch_no_mode", "half_wave_error",
    "perimeter_ramp", "piezo_step", "light_stuck", "light_noisy", "light_saturated", "light_nan",
    "piezo_adc_stuck", "piezo_adc_nan", "temperature_nan", "counter_bit_stuck", "frame_missed",
    "frame_repeated", "frame_late", "bias_lost", "bias_asymmetric", "field_pulse", "thermal_shock",
    "vibration", "shock", "overspeed",
]
AnalysisDeviations = Literal[
    "adev", "oadev", "mdev", "tdev", "hdev", "ohdev", "totdev", "mtotdev", "htotdev",
]


@dataclass
class Run(Section):
    """[run]"""

    #: length of the run; unset: 3600, or the length of the motion file [s]; allowed: above 0 up to 1e9
    duration_s: Optional[float] = None

    #: seed of all random numbers; the same seed gives the same run; allowed: 0..9223372036854775807
    seed: int = 1


@dataclass
class Gyro(Section):
    """[gyro]"""

    #: physics of a simulated gyro: told by [gyro] and [drift], or following from [laser]; allowed:
    #: "averaged", "laser"
    fidelity: Literal["averaged", "laser"] = "averaged"

    #: length of a tick: two half-periods of the bias [s]; allowed: 1e-6..10
    tick_s: float = 0.005

    #: angle per count [arcsec]; allowed: 1e-6..1e6
    scale_arcsec: float = 3.263

    #: bias frequency, mean over a half as the counter sees it, at zero detuning [Hz]; allowed: above 0 up to
    #: 1e12
    bias_hz: float = 60000.0

    #: loss of bias frequency: bias_hz (1 - bias_chi detuning^2), the detuning in wavelengths; allowed: from 0
    bias_chi: float = 3.6

    #: duration of a reversal of the bias field; below half a tick [s]; allowed: from 0
    bias_edge_s: float = 5e-05

    #: sign of the bias in the first half of every tick; allowed: -1 or 1
    first_bias_sign: int = 1

    #: temperature at which bias_hz holds [C]; allowed: above -1e6 to below 1e6
    reference_temperature_c: float = 20.0

    #: warming of the gyro in operation, approached with drift.thermal_time_s [C]; allowed: any finite number
    temperature_rise_c: float = 20.0

    #: relative change of the bias frequency with temperature [1/C]; allowed: any finite number
    bias_temperature_coefficient_per_c: float = 0.0

    #: samples of the light in a half; allowed: 1..64
    light_samples: int = 16

    #: noise of one light sample, white, as detuning [lambda]; allowed: from 0
    light_noise_lambda: float = 0.0033

    #: (I1 - I2)/(I1 + I2) per wavelength of detuning [1/lambda]; allowed: 1e-6..1e6 or -1e6..-1e-6
    discriminator_per_lambda: float = 0.332

    #: shifts of the bias edges against lock-in; auto: paired at low rates, random at high ones; allowed:
    #: "none", "auto", "paired", "random"
    dither: Literal["none", "auto", "paired", "random"] = "none"

    #: fringe rate above which the counter loses counts; unset: 1.01 times that of bias_hz and 400 deg/s [Hz];
    #: allowed: above 0
    counter_max_hz: Optional[float] = None


@dataclass
class Laser(Section):
    """[laser]"""

    #: length of the ring [m]; allowed: 0.001..1000
    perimeter_m: float = 0.16

    #: light lost in one round trip; allowed: 1e-9..0.5
    round_trip_loss_ratio: float = 0.007

    #: unsaturated gain over loss, at the centre without field; allowed: 1e-6..100
    gain_loss_ratio: float = 1.2

    #: where the velocity distribution falls to 1/e [Hz]; allowed: 1e6..1e12
    doppler_half_width_hz: float = 907000000.0

    #: where the line of an atom at rest falls to 1/2 [Hz]; allowed: 10000..1e13
    homogeneous_half_width_hz: float = 130000000.0

    #: distance of the centres of both neon isotopes [Hz]; allowed: 0..1e13
    isotope_shift_hz: float = 885000000.0

    #: share of the isotope with the higher frequency, neon 22; allowed: 0..1
    upper_isotope_ratio: float = 0.5

    #: shift of one circular component of the line by the field [Hz/G]; allowed: 0..1e12
    zeeman_hz_per_g: float = 1820000.0

    #: cross-saturation of waves on opposite components over that on the same one; allowed: 0..1
    opposite_sigma_coupling: float = 0.6

    #: plateau of the bias field at gyro.reference_temperature_c [G]; allowed: 1e-6..10000
    bias_field_g: float = 15.0

    #: beat frequency below which equal waves of the left mode lock [Hz]; allowed: 0..1e6
    lock_in_left_hz: float = 150.0

    #: beat frequency below which equal waves of the right mode lock [Hz]; allowed: 0..1e6
    lock_in_right_hz: float = 150.0

    #: phase by which the waves scattered back by the mirrors miss each other [deg]; allowed: -85..85
    scatter_phase_deg: float = 0.0

    #: of the fringe comparators, over the amplitude of the beat at the centre; allowed: 0..0.5
    comparator_threshold: float = 0.1

    #: counts a fringe; gyro.scale_arcsec and gyro.bias_hz are those of counts: x4 takes a quarter and four
    #: times of x1's; allowed: "x1", "x4"
    quadrature: Literal["x1", "x4"] = "x1"


@dataclass
class Drift(Section):
    """[drift]"""

    #: drift that changes its sign with the mode, at the start [arcsec/s]; allowed: any finite number
    magnetic_arcsec_s: float = 0.7

    #: growth of the magnetic drift by warming [arcsec/s]; allowed: any finite number
    magnetic_thermal_arcsec_s: float = 0.7

    #: time constant of the warming [s]; allowed: above 0
    thermal_time_s: float = 3000.0

    #: drift that is the same in both modes [arcsec/s]; allowed: any finite number
    nonmagnetic_arcsec_s: float = 0.05

    #: random walk of the angle; what makes it in fidelity laser is lock-in, and this only what is presumed
    #: [arcsec/sqrt(s)]; allowed: from 0
    random_walk_arcsec_sqrt_s: float = 0.14


@dataclass
class Perimeter(Section):
    """[perimeter]"""

    #: control of the perimeter; allowed: "analog", "exponential", "digital"
    loop: Literal["analog", "exponential", "digital"] = "analog"

    #: time constant of the loop [s]; allowed: 1e-6..1e6
    tau_s: float = 0.0065

    #: detuning at which the error signal is limited [lambda]; allowed: above 0 up to 1000
    limit_lambda: float = 0.09

    #: detuning when the loop closes after a switch, all causes included; 0: what comes of itself [lambda];
    #: allowed: from 0 to below 0.24
    miss_lambda: float = 0.22

    #: growth of the perimeter with temperature [lambda/C]; allowed: any finite number
    expansion_lambda_per_c: float = 0.025

    #: digital loop: halves after closing in which it corrects nearly all it sees; 0: the plain integrator of
    #: tau_s; allowed: 0..1000000
    relock_halves: int = 0

    #: digital loop, in these halves: part of the detuning corrected per light sample; allowed: 1e-9..1
    sample_gain: float = 0.12

    #: digital loop, after these halves: its time constant [s]; allowed: above 0 up to 1e6
    settled_tau_s: float = 0.025

    #: set-points a half, of an open loop and of a digital one with relock_halves; allowed: 1..16
    set_points: int = 16

    #: calibrated points of the discriminator besides 0, growing, 31 at most on a side; those above 0 alone:
    #: the other side is their mirror image; none: gyro.discriminator_per_lambda alone [lambda]; allowed: one
    #: number or an array, [] included, each -1000..1000
    discriminator_detuning_lambda: list[float] = field(default_factory=list)

    #: (I1 - I2)/(I1 + I2) at each of these detunings, of the same sign, growing; allowed: one number or an
    #: array, [] included, each -1000..1000
    discriminator_signal: list[float] = field(default_factory=list)

    #: detuning, on that scale, at which the bias is largest: bias_hz (1 - bias_chi (detuning - centre)^2)
    #: [lambda]; allowed: -0.2..0.2
    discriminator_centre_lambda: float = 0.0


@dataclass
class Piezo(Section):
    """[piezo]"""

    #: voltage that moves the perimeter by half a wavelength, at gyro.reference_temperature_c [V]; allowed:
    #: 0.001..1e6
    half_wave_v: float = 40.0

    #: relative change of the half-wave voltage with temperature [1/C]; allowed: any finite number
    half_wave_temperature_coefficient_per_c: float = 0.0

    #: relative error of the half-wave voltage that control presumes at first; allowed: -0.9..0.9
    half_wave_error: float = 0.0

    #: time constant of the high-voltage stage [s]; allowed: 1e-6..1000
    rc_s: float = 0.001

    #: fastest change of the high voltage [V/s]; allowed: above 0 up to 1e12
    slew_v_s: float = 4000.0

    #: lower end of the high voltage [V]; allowed: above -1e6 to below 1e6
    range_min_v: float = 0.0

    #: upper end of the high voltage; above the lower [V]; allowed: above -1e6 to below 1e6
    range_max_v: float = 300.0

    #: width of a voltage loop of piezo.hysteresis_stroke_v over its height; 0: none; allowed: 0..0.4
    hysteresis: float = 0.0

    #: stroke of the loop to which piezo.hysteresis refers [V]; allowed: above 0
    hysteresis_stroke_v: float = 300.0

    #: growth of a stroke per decade of time, from 10 ms to 10^4 s; 0: none; allowed: 0..0.05
    creep_per_decade: float = 0.0

    #: resonance of the mirror; 0: rigid, else 100 or more [Hz]; allowed: 0 or 100..1e6
    mirror_hz: float = 0.0

    #: damping of that resonance, as a part of the critical; allowed: 0.001..0.999
    mirror_damping: float = 0.05

    #: resolution of the set-point; allowed: 1..24
    dac_bits: int = 12

    #: resolution of the voltage that is read back; allowed: 1..24
    adc_bits: int = 12

    #: noise of the voltage that is read back [V]; allowed: from 0
    adc_noise_v: float = 0.02


@dataclass
class Switching(Section):
    """[switching]"""

    #: from one opening of the loop to the next; at least gap_ticks + 2 ticks [s]; allowed: above 0 up to 1e9,
    #: or "optimal"
    interval_s: Union[float, Literal["optimal"]] = 90.0

    #: length of the first segment: an interval or half of one; allowed: "full", "half"
    first_segment: Literal["full", "half"] = "full"

    #: half: the last switch before the end of the run comes where the times in both modes are equal at the
    #: end; allowed: "any", "half"
    last_segment: Literal["any", "half"] = "any"

    #: fixed: a grid of interval_s; growing: with the cube root of time; measured: by the errors of the
    #: switches and the drift that compensation finds; allowed: "fixed", "growing", "measured"
    schedule: Literal["fixed", "growing", "measured"] = "fixed"

    #: shortest interval of a schedule that is not fixed [s]; allowed: above 0 up to 1e9
    interval_min_s: float = 10.0

    #: longest interval of a schedule that is not fixed [s]; allowed: above 0 up to 1e9
    interval_max_s: float = 600.0

    #: rms error of one switch, presumed by a schedule that is not fixed until it is measured [arcsec];
    #: allowed: above 0 up to 1e12
    switch_error_arcsec: float = 2.0

    #: drift that changes its sign with the mode, presumed likewise [arcsec/s]; allowed: above 0 up to 1e12
    magnetic_arcsec_s: float = 0.7

    #: ticks for which the loop stays open at a switch; allowed: 1..16
    gap_ticks: int = 3

    #: from so many ticks on the loop closes as soon as light and piezo have arrived; up to gap_ticks, 0:
    #: gap_ticks; allowed: 0..16
    gap_min_ticks: int = 0


@dataclass
class Compensation(Section):
    """[compensation]"""

    #: correction of the false drift after closing; unset: mean_square where the log has detuning, none where
    #: not; allowed: "none", "frequency", "detuning", "mean_square", "joint"
    relock: Optional[Literal["none", "frequency", "detuning", "mean_square", "joint"]] = None

    #: ticks after closing that are corrected; allowed: 0..1000000
    relock_ticks: int = 20

    #: what replaces the ticks of a gap; allowed: "none", "constant", "linear", "quadratic", "optimal", "auto"
    bridge: Literal["none", "constant", "linear", "quadratic", "optimal", "auto"] = "auto"

    #: measured ticks before a gap from which it is extrapolated; allowed: 1..8
    extrapolation_points: int = 4

    #: measured ticks before a gap from which it is interpolated; allowed: 1..8
    points_before: int = 2

    #: measured ticks after a gap from which it is interpolated; allowed: 1..8
    points_after: int = 2

    #: what bridge = optimal presumes of the motion: what it learnt between gaps, a flat band of rates, or
    #: known lines; allowed: "learnt", "flat", "lines"
    prior: Literal["learnt", "flat", "lines"] = "learnt"

    #: upper edge of the flat band; a little above the motion's [Hz]; allowed: above 0 up to 1e9
    prior_band_hz: float = 24.0

    #: rms rate in the flat band [arcsec/s]; allowed: above 0 up to 1e9
    prior_rate_arcsec_s: float = 8485.0

    #: frequencies of the known lines [Hz]; allowed: one number or an array, each above 0 up to 1e9
    prior_line_hz: list[float] = field(default_factory=lambda: [20.0])

    #: their amplitudes, as many as frequencies [arcsec/s]; allowed: one number or an array, each above 0 up
    #: to 1e9
    prior_line_arcsec_s: list[float] = field(default_factory=lambda: [12000.0])

    #: drift that changes its sign with the mode: left in the angle, estimated only, or estimated and taken
    #: out; allowed: "none", "watch", "estimate"
    magnetic: Literal["none", "watch", "estimate"] = "none"

    #: that drift at the start, by calibration [arcsec/s]; allowed: -1e6..1e6
    magnetic_arcsec_s: float = 0.0

    #: standard deviation of magnetic_arcsec_s; the default is that of no calibration [arcsec/s]; allowed:
    #: 0..1e6
    magnetic_sigma_arcsec_s: float = 10.0

    #: growth of that drift by warming, by calibration [arcsec/s]; allowed: -1e6..1e6
    magnetic_thermal_arcsec_s: float = 0.0

    #: standard deviation of magnetic_thermal_arcsec_s; the default is that of no calibration [arcsec/s];
    #: allowed: 0..1e6
    magnetic_thermal_sigma_arcsec_s: float = 10.0

    #: time constant of the warming, presumed [s]; allowed: 1e-9..1e12
    magnetic_thermal_time_s: float = 3000.0


@dataclass
class Motion(Section):
    """[motion]"""

    #: how the gyro is turned; allowed: "rest", "constant", "sine", "sum", "file"
    kind: Literal["rest", "constant", "sine", "sum", "file"] = "sine"

    #: constant rate; added to sine and sum [arcsec/s]; allowed: any finite number
    rate_arcsec_s: float = 0.0

    #: amplitudes of the rate; one for sine, one or more for sum [arcsec/s]; allowed: one number or an array,
    #: each any finite number
    amplitude_arcsec_s: list[float] = field(default_factory=lambda: [12000.0])

    #: frequencies, as many as amplitudes [Hz]; allowed: one number or an array, each from 0
    frequency_hz: list[float] = field(default_factory=lambda: [7.03])

    #: phases at the start, as many as amplitudes [deg]; allowed: one number or an array, each any finite
    #: number
    phase_deg: list[float] = field(default_factory=lambda: [0.0])

    #: the motion file, for kind file; allowed: any text
    path: str = ""

    #: column of the file, by its number from 1 or its name; unset: 1, but no column of times; allowed: a
    #: number 1..1000000, or a name
    column: Optional[Union[int, str]] = None

    #: whether the column holds angle increments or rates; allowed: "increment", "rate"
    column_holds: Literal["increment", "rate"] = "increment"

    #: angle (or rate in arcsec/s) per unit of the column [arcsec]; allowed: any finite number but 0
    scale_arcsec: float = 1.0

    #: rows of the file per second [Hz]; allowed: above 0
    rate_hz: float = 100.0

    #: lines of the file that begin with this are skipped; allowed: any text
    comment: str = "#"

    #: lines of numbers to skip at the head of the file; allowed: 0..2147483647
    skip_lines: int = 0

    #: what parts the columns of the file; auto: recognised, together with the decimal mark; allowed: "auto",
    #: "space", "tab", "semicolon", "comma", "bar"
    separator: Literal["auto", "space", "tab", "semicolon", "comma", "bar"] = "auto"

    #: decimal mark of the file; auto: recognised, together with the separator; allowed: "auto", "point",
    #: "comma"
    decimal: Literal["auto", "point", "comma"] = "auto"

    #: column with the time of each row, against which rate_hz is checked; 0: none; unset: looked for;
    #: allowed: a number 0..1000000, or a name
    time_column: Optional[Union[int, str]] = None


@dataclass
class Faults(Section):
    """[faults]"""

    #: what breaks in a simulated gyro, fault by fault; allowed: one or an array, [] included, of "laser_off",
    #: "beam_fades", "mode_hop", "switch_wrong_mode", "switch_no_mode", "half_wave_error", "perimeter_ramp",
    #: "piezo_step", "light_stuck", "light_noisy", "light_saturated", "light_nan", "piezo_adc_stuck",
    #: "piezo_adc_nan", "temperature_nan", "counter_bit_stuck", "frame_missed", "frame_repeated",
    #: "frame_late", "bias_lost", "bias_asymmetric", "field_pulse", "thermal_shock", "vibration", "shock",
    #: "overspeed"
    kind: list[FaultsKind] = field(default_factory=list)

    #: when each begins [s]; allowed: one number or an array, [] included, each 0..1e9
    at_s: list[float] = field(default_factory=list)

    #: how long each lasts [s]; allowed: one number or an array, [] included, each 0..1e9
    duration_s: list[float] = field(default_factory=list)

    #: how large each is, in the unit of its kind; allowed: one number or an array, [] included, each any
    #: finite number
    size: list[float] = field(default_factory=list)

    #: frequency of the kind vibration [Hz]; allowed: 0.001..1e6
    vibration_hz: float = 170.0

    #: more of them at random moments [1/h]; allowed: 0..1e6
    random_per_hour: float = 0.0

    #: seed of their moments, kinds, durations and sizes; allowed: 0..9223372036854775807
    random_seed: int = 1

    #: their kinds; none: all; allowed: one or an array, [] included, of "laser_off", "beam_fades",
    #: "mode_hop", "switch_wrong_mode", "switch_no_mode", "half_wave_error", "perimeter_ramp", "piezo_step",
    #: "light_stuck", "light_noisy", "light_saturated", "light_nan", "piezo_adc_stuck", "piezo_adc_nan",
    #: "temperature_nan", "counter_bit_stuck", "frame_missed", "frame_repeated", "frame_late", "bias_lost",
    #: "bias_asymmetric", "field_pulse", "thermal_shock", "vibration", "shock", "overspeed"
    random_kinds: list[FaultsKind] = field(default_factory=list)


@dataclass
class Design(Section):
    """[design]"""

    #: error of the angle that one switch leaves: the dP of the paper's budgets; given, also the rms for
    #: interval_s = "optimal", which else is found by a trial on the twin [arcsec]; allowed: from 0
    switch_error_arcsec: float = 10.0

    #: lengths of run for which the design is worked out [s]; allowed: one number or an array, each above 0
    run_lengths_s: list[float] = field(default_factory=lambda: [600.0, 900.0, 3600.0, 36000.0])


@dataclass
class Analysis(Section):
    """[analysis]"""

    #: which deviations are computed; the first is the one that is drawn; allowed: one or an array, []
    #: included, of "adev", "oadev", "mdev", "tdev", "hdev", "ohdev", "totdev", "mtotdev", "htotdev"
    deviations: list[AnalysisDeviations] = field(default_factory=lambda: ["oadev"])

    #: averaging times: octave, decade (1, 2, 4, 10), log (taus_per_decade), all; allowed: "octave", "decade",
    #: "log", "all"
    taus: Literal["octave", "decade", "log", "all"] = "octave"

    #: of taus = log; allowed: 1..10000
    taus_per_decade: int = 20

    #: averaging times, instead of taus [s]; allowed: one number or an array, [] included, each above 0
    taus_s: list[float] = field(default_factory=list)

    #: of the intervals; allowed: above 0 up to 0.999999
    confidence: float = 0.95

    #: share of an averaging time that must be known for it to count; allowed: above 0 up to 1
    least_known_ratio: float = 0.9

    #: bias that mirroring gives totdev, mtotdev and htotdev: removed, removed as NIST publishes it, or
    #: as_computed, which is what Stable32 and AllanTools print; allowed: "removed", "published",
    #: "as_computed"
    total_bias: Literal["removed", "published", "as_computed"] = "removed"

    #: of rates in text and report; JSON has arcsec/s; allowed: "deg/h", "arcsec/s", "deg/s", "rad/s"
    unit: Literal["deg/h", "arcsec/s", "deg/s", "rad/s"] = "deg/h"

    #: which angle of an angle log: known afterwards, or as delivered in real time; allowed: "final",
    #: "delivered"
    angles: Literal["final", "delivered"] = "final"

    #: where the gyro stood, to compare with the Earth's rate [deg]; allowed: -90..90
    latitude_deg: Optional[float] = None

    #: columns of a text file, by number from 1 or by name; unset: 1, but no column of times; allowed: one or
    #: an array, [] included, of numbers 1..1000000 and names
    column: list[Union[int, str]] = field(default_factory=list)

    #: what the columns of a text file hold; unset: as [motion] describes them, if it does; allowed:
    #: "increment", "rate", "phase"
    column_holds: Optional[Literal["increment", "rate", "phase"]] = None

    #: angle (or rate in arcsec/s) per unit of the columns [arcsec]; allowed: any finite number but 0
    scale_arcsec: float = 1.0

    #: rows of the text file per second [Hz]; allowed: above 0
    rate_hz: Optional[float] = None

    #: lines of a text file that begin with this are skipped; allowed: any text
    comment: str = "#"

    #: lines of numbers to skip at the head of a text file; allowed: 0..2147483647
    skip_lines: int = 0

    #: what parts the columns of a text file; auto: recognised, together with the decimal mark; allowed:
    #: "auto", "space", "tab", "semicolon", "comma", "bar"
    separator: Literal["auto", "space", "tab", "semicolon", "comma", "bar"] = "auto"

    #: decimal mark of a text file; auto: recognised, together with the separator; allowed: "auto", "point",
    #: "comma"
    decimal: Literal["auto", "point", "comma"] = "auto"

    #: column with the time of each row, against which rate_hz is checked; 0: none; unset: looked for;
    #: allowed: a number 0..1000000, or a name
    time_column: Optional[Union[int, str]] = None

    #: column with the rate of a rate table, by number or name; 0 or unset: the gyro stood on none; allowed: a
    #: number 0..1000000, or a name
    table_column: Optional[Union[int, str]] = None

    #: rate per unit of that column [arcsec/s]; allowed: any finite number but 0
    table_scale_arcsec_s: float = 1.0

    #: beginning of each stage of the table that is left out [s]; allowed: from 0
    table_settling_s: float = 0.0

    #: rates of the table this near to each other, of its largest, are of one stage; allowed: 0..1
    table_same_rate_ratio: float = 0.0001

    #: rotation about the gyro's axis that the table does not show; the bias is then without it [arcsec/s];
    #: allowed: any finite number
    table_earth_arcsec_s: float = 0.0


@dataclass
class Sections:
    """All sections."""

    run: Run = field(default_factory=Run)
    gyro: Gyro = field(default_factory=Gyro)
    laser: Laser = field(default_factory=Laser)
    drift: Drift = field(default_factory=Drift)
    perimeter: Perimeter = field(default_factory=Perimeter)
    piezo: Piezo = field(default_factory=Piezo)
    switching: Switching = field(default_factory=Switching)
    compensation: Compensation = field(default_factory=Compensation)
    motion: Motion = field(default_factory=Motion)
    faults: Faults = field(default_factory=Faults)
    design: Design = field(default_factory=Design)
    analysis: Analysis = field(default_factory=Analysis)
