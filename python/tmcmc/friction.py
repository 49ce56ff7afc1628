"""Base-excited oscillator with Coulomb friction (Den Hartog 1930), as far as its motion is continuous, and its likelihood."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

LimitRule = Literal["supremum", "grid"]
PhaseRule = Literal["fourier_coefficient", "discrete_bin"]

#: The parameters of Likelihood, in the order of its columns: N, Hz, degrees, dimensionless.
PARAMETERS = ("friction_force_n", "natural_frequency_hz", "phase_noise_deg", "frequency_ratio_noise")


def phase(
    force_ratio: ArrayLike,
    frequency_ratio: ArrayLike,
    *,
    limit: LimitRule = "supremum",
    rule: PhaseRule = "fourier_coefficient",
) -> NDArray[np.float64]:
    """Phase angle of the response in degrees, in [0, 180]; nan where the motion sticks.

    Args:
        force_ratio: friction force over driving force.
        frequency_ratio: driving over natural frequency; the two are broadcast against each other.
        limit: how the limit of continuous motion is taken: the supremum over the half-period, or the grid of the published scripts.
        rule: first Fourier coefficient, or the bin of a discrete transform that the published scripts take.

    Raises:
        ValueError: for a frequency ratio that is singular (1, 1/3, 1/5, ...) or not in [1e-4, 1e6].
    """
    _check(limit, rule)
    phi, r = np.broadcast_arrays(np.asarray(force_ratio, dtype=np.float64), np.asarray(frequency_ratio, dtype=np.float64))
    return _core.phase(phi.ravel(), r.ravel(), limit, rule).reshape(phi.shape)


class Likelihood:
    """Log-likelihood of friction force, natural frequency and both noise levels (PARAMETERS), for tmcmc.sample."""

    def __init__(
        self,
        observations: Mapping[str, ArrayLike],
        *,
        driving_force_n: float = 2.5,
        limit: LimitRule = "supremum",
        rule: PhaseRule = "fourier_coefficient",
        infeasible_log_likelihood: float = -np.inf,
    ) -> None:
        """
        Args:
            observations: arrays of one length under the names nominal_ratio, measured_ratio, driving_frequency_hz and
                phase_deg.
            driving_force_n: stiffness times base amplitude, N.
            limit, rule: as in phase().
            infeasible_log_likelihood: value where the motion of some observation sticks.

        Raises:
            ValueError: naming the field and the row of an observation that makes no sense.
        """
        _check(limit, rule)
        columns = []
        for name in ("nominal_ratio", "measured_ratio", "driving_frequency_hz", "phase_deg"):
            if name not in observations:
                raise ValueError(f"observations: expected a column {name}")
            columns.append(np.asarray(observations[name], dtype=np.float64).ravel().tolist())
        self._likelihood = _core.Likelihood(*columns, driving_force_n, limit, rule, infeasible_log_likelihood)

    def __call__(self, points: ArrayLike) -> NDArray[np.float64]:
        """The log-likelihoods of an (n, 4) array of points."""
        return self._likelihood(np.asarray(points, dtype=np.float64))

    @property
    def limit_friction_force_n(self) -> float:
        """The largest friction force, N, at which the motion is continuous for every observation."""
        return self._likelihood.limit_friction_force_n


def _check(limit: str, rule: str) -> None:
    for name, value, choices in (("limit", limit, ("supremum", "grid")), ("rule", rule, ("fourier_coefficient", "discrete_bin"))):
        if value not in choices:
            raise ValueError(f"{name} = {value!r}: expected one of {', '.join(choices)}")
