"""Deviations and noise from Python; expected values are published or follow from mathematics."""

import tracemalloc

import numpy as np
import pytest

import zlg
from zlg import analysis

# The nine values of NBS Monograph 140 and the deviations of NIST SP 1065, table 31.
NBS = np.array([892.0, 809.0, 823.0, 798.0, 671.0, 644.0, 883.0, 903.0, 677.0])
PUBLISHED = {
    "adev": (91.22945, 115.8082),
    "oadev": (91.22945, 85.95287),
    "mdev": (91.22945, 74.78849),
    "tdev": (52.67135, 86.35831),
    "hdev": (70.80607, 116.7980),
    "ohdev": (70.80607, 85.61487),
}


@pytest.mark.parametrize("kind", PUBLISHED)
def test_published_values(kind):
    taus, devs, errs, ns = getattr(analysis, kind)(NBS, 1.0, data_type="rate", taus=[1.0, 2.0])
    assert np.array_equal(taus, [1.0, 2.0])
    assert devs == pytest.approx(PUBLISHED[kind], rel=1e-6)
    assert (errs > 0).all() and (ns > 0).all()


@pytest.mark.parametrize("kind", analysis.KINDS)
def test_rate_increments_and_phase_say_the_same(kind):
    rates = np.random.default_rng(1).normal(size=200)
    phase = np.concatenate([[0.0], np.cumsum(rates) / 5.0])
    known = getattr(analysis, kind)
    by_rate = known(rates, 5.0, data_type="rate")
    assert np.allclose(known(rates, 5.0, data_type="freq").devs, by_rate.devs, rtol=0)
    assert np.allclose(known(rates / 5.0, 5.0, data_type="increments").devs, by_rate.devs, rtol=1e-12)
    assert np.allclose(known(phase, 5.0, data_type="phase").devs, by_rate.devs, rtol=1e-9)


def test_the_data_type_must_be_said():
    with pytest.raises(TypeError, match="data_type must be given"):
        analysis.oadev(NBS, 1.0)
    with pytest.raises(zlg.SeriesError, match="phase"):
        analysis.oadev(NBS, 1.0, data_type="angle")
    with pytest.raises(zlg.SeriesError):
        analysis.deviation("oadev", NBS, rate_hz=1.0, data_type="rate", unit="arcsec")


def test_units_are_converted():
    in_deg_s = analysis.deviation("adev", NBS / 3600.0, rate_hz=1.0, data_type="rate", unit="deg/s", taus=[1.0])
    assert in_deg_s.deviation[0] == pytest.approx(91.22945, rel=1e-6)


def test_missing_samples_are_not_counted():
    rates = np.random.default_rng(2).normal(size=1000)
    holes = rates.copy()
    holes[100:200] = np.nan
    valid = np.isfinite(holes)
    by_nan = analysis.oadev(holes, data_type="rate", taus=[1.0])
    by_mask = analysis.oadev(rates, data_type="rate", taus=[1.0], valid=valid)
    both = valid[1:] & valid[:-1]
    expected = np.sqrt(0.5 * np.mean(np.diff(rates)[both] ** 2))
    assert by_nan.devs[0] == by_mask.devs[0] == pytest.approx(expected, rel=1e-12)
    assert by_nan.ns[0] == both.sum() == 898


def test_masked_samples_are_missing():
    rates = np.random.default_rng(2).normal(size=1000)
    missing = np.arange(1000) // 10 == 7
    by_valid = analysis.oadev(rates, 1.0, "rate", "octave", ~missing)
    by_mask = analysis.oadev(np.ma.masked_array(rates, missing), 1.0, "rate")
    masked_valid = analysis.oadev(rates, 1.0, "rate", valid=np.ma.masked_array(np.ones(1000, dtype=bool), missing))
    assert np.array_equal(by_mask.devs, by_valid.devs) and np.array_equal(masked_valid.devs, by_valid.devs)
    counts = np.ma.masked_array(np.arange(1000) ** 2, missing)
    assert analysis.oadev(counts, 1.0, "rate", [1.0]).ns[0] == by_valid.ns[0] == 988  # 999 pairs less 11


@pytest.mark.parametrize("valid", [[1.0, np.nan, 1.0], [1, 2, 1], ["a", "b", "c"]])
def test_a_mask_is_of_yes_and_no(valid):
    with pytest.raises(ValueError):
        analysis.oadev([1.0, 2.0, 4.0], 1.0, "rate", valid=valid)
    assert analysis.oadev([1.0, 2.0, 4.0], 1.0, "rate", valid=[1, 1, 1]).ns[0] == 2


def test_the_signature_that_people_know():
    taus, devs, errs, ns = analysis.oadev(NBS, 1.0, "freq", [1.0, 2.0, 4.0, 5.0, 1e9])
    assert np.array_equal(taus, [1.0, 2.0, 4.0])  # of 9 values those to half the record
    with pytest.raises(zlg.SeriesError):
        analysis.oadev(NBS, 1.0, "freq", [5.0])
    with pytest.raises(zlg.SeriesError, match="allowed is 1 to"):
        analysis.oadev(NBS, 1.0, "freq", [np.nan, 1.0])
    with pytest.raises(zlg.SeriesError, match="allowed is 1 to 4"):
        analysis.deviation("oadev", NBS, rate_hz=1.0, data_type="rate", unit="1", taus=[1.0, 5.0])


def test_taus():
    data = np.random.default_rng(3).normal(size=1000)
    assert analysis.adev(data, data_type="rate", taus="decade").taus.tolist() == [1, 2, 4, 10, 20, 40, 100, 200, 400]
    assert len(analysis.adev(data, data_type="rate", taus="all").taus) == 500
    with pytest.raises(zlg.SeriesError, match="octave, decade"):
        analysis.adev(data, data_type="rate", taus="octaves")


@pytest.mark.parametrize("bad", [[], [1.0], [np.nan] * 9, [2.0] * 9])
def test_useless_records_are_told(bad):
    with pytest.raises(zlg.SeriesError) as caught:
        analysis.oadev(bad, data_type="rate")
    assert "\n" not in str(caught.value)
    with pytest.raises(ValueError, match="dimensions"):
        analysis.oadev(np.ones((3, 3)), data_type="rate")


def test_arrays_are_read_where_they_are():
    data = np.random.default_rng(4).normal(size=1_000_000)
    valid = np.ones(len(data), dtype=bool)
    tracemalloc.start()
    d = analysis.deviation("oadev", data, rate_hz=1.0, data_type="rate", unit="1", valid=valid)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 500_000  # bytes; a copy would take 8 000 000
    assert not d.deviation.flags.owndata  # the memory is that of C++


def test_white_noise_is_found_with_its_error():
    random = np.random.default_rng(6)
    rates = random.normal(0.0, 0.3 * np.sqrt(10.0), 50_000)  # 0.3 arcsec/sqrt(s) at 10 Hz
    fit = analysis.fit_noise(rates, rate_hz=10.0, data_type="rate", unit="arcsec/s")
    found = fit["angle random walk"]
    assert found.found and abs(found.value - 0.3) < 4 * found.sigma < 0.02
    assert not fit["ramp"].found
    assert fit.terms.angle_random_walk_arcsec_sqrt_s == found.value
    assert isinstance(fit.terms.allan_variance(4.0), np.ndarray)
    assert fit.terms.allan_variance(4.0) == pytest.approx(found.value**2 / 4.0)
    with pytest.raises(KeyError, match="allowed are"):
        fit["walk"]


def test_white_noise_behind_a_low_pass_is_found_with_its_bandwidth():
    white = np.random.default_rng(38).normal(0.0, 5.0 * np.sqrt(200.0), 200_000)  # N = 5 arcsec/sqrt(s)
    averaged = np.convolve(white, np.full(6, 1.0 / 6.0), "valid")
    fit = analysis.fit_noise(averaged, rate_hz=200.0, data_type="rate", unit="arcsec/s")
    n = fit["angle random walk"]
    assert n.value == pytest.approx(5.0, abs=4.0 * n.sigma)
    assert n.sigma < 0.1
    # |sin(pi f L)/(pi f L)|^2 of L = 30 ms is a half at 0.443/L.
    assert n.second == pytest.approx(0.443 / 0.03, rel=0.1)
    assert fit.describes and fit.from_tau_s > 0.005
    assert not fit["exponentially correlated"].found
    spectrum = fit.terms.rate_spectrum(np.array([0.01]), 200.0)
    assert spectrum[0] == pytest.approx(n.value**2, rel=0.01)


def test_data_sheet_and_back():
    terms = analysis.terms_of_data_sheet(angle_random_walk_deg_sqrt_h=0.002, bias_instability_deg_h=0.0045)
    assert terms.angle_random_walk_arcsec_sqrt_s == pytest.approx(0.12)  # 0.002 * 3600/60
    assert analysis.data_sheet(terms)["bias_instability_deg_h"] == pytest.approx(0.0045)
    assert analysis.discrete_noise(terms, 200.0).white_rate_arcsec_s == pytest.approx(0.12 * np.sqrt(200.0))


def test_imu_yaml():
    terms = analysis.terms_of_data_sheet(angle_random_walk_deg_sqrt_h=0.002, rate_random_walk_deg_h_sqrt_h=0.006)
    values = dict(line.split("#")[0].split(": ") for line in analysis.imu_yaml(terms, 200.0).splitlines() if line[0] != "#")
    assert float(values["update_rate"]) == 200.0
    assert float(values["gyroscope_random_walk"]) * 648000.0 / np.pi == pytest.approx(1e-4, rel=1e-5)


def test_spectrum_of_white_noise():
    rates = np.random.default_rng(7).normal(size=20_000)
    f, density = analysis.welch_spectrum(rates, 10.0, 256)
    assert f[-1] == 5.0 and np.mean(density) == pytest.approx(0.2, rel=0.05)  # 2/rate, one-sided


def test_modes_are_split():
    mode = np.tile(np.repeat([1, -1], 1000), 6)
    rates = 0.05 + 0.7 * mode
    split = analysis.split_modes(rates, mode, rate_hz=10.0)
    assert np.allclose(split.magnetic_arcsec_s, 0.7) and np.allclose(split.nonmagnetic_arcsec_s, 0.05)
    with pytest.raises(zlg.SeriesError):
        analysis.split_modes(rates, mode[1:], rate_hz=10.0)
    with pytest.raises(ValueError, match="mode"):
        analysis.split_modes(rates, 257 * mode, rate_hz=10.0)


def test_a_rate_table():
    stages = np.repeat([-3600.0, 0.0, 3600.0, 7200.0], 500)
    output = (stages + 9.0) / 3.25 + np.random.default_rng(8).normal(0.0, 1e-3, len(stages))
    table = analysis.rate_table(stages, output)
    value, sigma = table.arcsec_per_unit
    assert abs(value - 3.25) < 5 * sigma < 1e-5
    assert table.bias_arcsec_s[0] == pytest.approx(9.0, abs=1e-3)
    with pytest.raises(zlg.SeriesError):
        analysis.rate_table(stages[:600], output[:600])


def test_the_total_deviation_with_and_without_the_bias_of_mirroring():
    rates, number = [], 1234567890
    for _ in range(1000):
        rates.append(number / 2147483647)
        number = 16807 * number % 2147483647
    # NIST SP 1065, table 31.
    plain = analysis.totdev(rates, 1.0, "freq", [100.0])
    assert plain.devs[0] == pytest.approx(3.406530e-2, abs=1e-8)
    removed = analysis.deviation("totdev", rates, rate_hz=1.0, data_type="rate", unit="1", taus=[100.0], noise=-2)
    assert removed.as_computed[0] == plain.devs[0]
    assert plain.devs[0] < removed.deviation[0]
