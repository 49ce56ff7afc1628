from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

__version__: str

Marginals = Sequence[tuple[str, str, dict[str, float]]]

class SamplingError(RuntimeError): ...

def check_prior(marginals: Marginals) -> str: ...
def distributions() -> list[tuple[str, list[str]]]: ...

def run(
    log_likelihood: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    marginals: Marginals,
    evaluations: int,
    chains: int | None,
    seed: int,
    run: int,
    options: dict[str, str],
) -> dict[str, Any]: ...
def find_modes(
    samples: NDArray[np.float64], weights: NDArray[np.float64], chains: int, parents: Sequence[Sequence[int]]
) -> tuple[list[dict[str, Any]], NDArray[np.intp], list[str]]: ...
def options() -> list[tuple[str, str, str]]: ...
def envelope(
    samples: Sequence[Sequence[float]],
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]: ...
def area(samples: Sequence[Sequence[float]]) -> float: ...
def phase(
    force_ratio: NDArray[np.float64], frequency_ratio: NDArray[np.float64], limit: str, rule: str
) -> NDArray[np.float64]: ...

class Likelihood:
    def __init__(
        self,
        nominal_ratio: Sequence[float],
        measured_ratio: Sequence[float],
        driving_frequency_hz: Sequence[float],
        phase_deg: Sequence[float],
        driving_force_n: float,
        limit: str,
        rule: str,
        infeasible: float,
    ) -> None: ...
    def __call__(self, points: NDArray[np.float64]) -> NDArray[np.float64]: ...
    @property
    def limit_friction_force_n(self) -> float: ...
