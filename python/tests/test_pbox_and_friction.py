"""p-boxes and the friction oscillator against closed forms and published data."""

import csv
from pathlib import Path

import numpy as np
import pytest

import tmcmc

TABLE1 = Path(__file__).parents[2] / "data/published/table1_observations.csv"


def observations():
    with TABLE1.open() as file:
        rows = list(csv.DictReader(file))
    columns = {"nominal_ratio": "r_nominal", "measured_ratio": "r_measured"}
    names = ("nominal_ratio", "measured_ratio", "driving_frequency_hz", "phase_deg")
    return {name: [float(row[columns.get(name, name)]) for row in rows] for name in names}


def test_a_pbox_bounds_the_distribution_functions():
    box = tmcmc.pbox.envelope([[1.0, 3.0], [2.0, 2.0, 5.0]])
    assert box.x.tolist() == [1.0, 2.0, 3.0, 5.0]
    assert np.allclose(box.lower, [0.0, 0.5, 2.0 / 3.0, 1.0])
    assert np.allclose(box.upper, [0.5, 2.0 / 3.0, 1.0, 1.0])
    assert tmcmc.pbox.area([[1.0, 3.0], [2.0, 2.0, 5.0]]) == pytest.approx(0.5 + 1.0 / 6.0 + 2.0 / 3.0)


def test_the_area_of_shifted_samples_is_the_shift():
    sample = np.random.default_rng(1).normal(size=100)
    assert tmcmc.pbox.area([sample, sample + 0.25]) == pytest.approx(0.25)
    assert tmcmc.pbox.area([sample]) == 0.0
    for bad in ([], [[]], [[float("nan")]]):
        with pytest.raises(ValueError):
            tmcmc.pbox.area(bad)


def test_without_friction_the_response_is_in_phase_below_resonance_and_opposite_above():
    assert tmcmc.friction.phase(0.0, [0.4, 0.7, 1.5]).tolist() == [0.0, 0.0, 180.0]
    angles = tmcmc.friction.phase(np.array([0.1, 0.2])[:, None], [0.7, 0.8, 1.5])
    assert angles.shape == (2, 3)
    assert np.all((angles > 0.0) & (angles < 180.0))
    assert np.isnan(tmcmc.friction.phase(5.0, 0.7))
    with pytest.raises(ValueError):
        tmcmc.friction.phase(0.1, 1.0)
    with pytest.raises(ValueError, match="limit = 'none'"):
        tmcmc.friction.phase(0.1, 0.7, limit="none")


def test_the_likelihood_is_that_of_normal_residuals():
    data = observations()
    likelihood = tmcmc.friction.Likelihood(data)
    force, frequency, phase_noise, ratio_noise = 0.6, 3.9, 4.0, 0.02
    phases = tmcmc.friction.phase(force / 2.5, data["measured_ratio"])
    z_phase = (np.array(data["phase_deg"]) - phases) / phase_noise
    z_ratio = (np.array(data["nominal_ratio"]) - np.array(data["driving_frequency_hz"]) / frequency) / ratio_noise
    expected = -0.5 * np.sum(z_phase**2 + z_ratio**2) - len(phases) * np.log(2.0 * np.pi * phase_noise * ratio_noise)
    points = np.array([[force, frequency, phase_noise, ratio_noise], [1e3, frequency, phase_noise, ratio_noise]])
    values = likelihood(points)
    assert values[0] == pytest.approx(expected, rel=1e-12)
    assert values[1] == -np.inf
    assert force < likelihood.limit_friction_force_n < 1e3


def test_observations_that_make_no_sense_are_named():
    data = observations()
    with pytest.raises(ValueError, match="phase_deg"):
        tmcmc.friction.Likelihood({**data, "phase_deg": [1e6] * len(data["phase_deg"])})
    with pytest.raises(ValueError, match="expected a column measured_ratio"):
        tmcmc.friction.Likelihood({"nominal_ratio": [0.5]})
