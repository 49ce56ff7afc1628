"""Probability boxes of empirical distribution functions (Ferson et al., SAND2002-4015, 2003) and their area."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core


@dataclass(frozen=True)
class PBox:
    """Right-continuous step bounds of distribution functions: on [x[i], x[i + 1]) all lie in [lower[i], upper[i]]."""

    x: NDArray[np.float64]  #: breakpoints, strictly increasing, in the unit of the samples
    lower: NDArray[np.float64]  #: least fraction
    upper: NDArray[np.float64]  #: largest fraction


def envelope(samples: Sequence[ArrayLike]) -> PBox:
    """The tightest p-box around the empirical distribution functions of several samples; their sizes may differ.

    Raises:
        ValueError: for no sample, an empty one or a value that is not finite.
    """
    return PBox(*_core.envelope(_lists(samples)))


def area(samples: Sequence[ArrayLike]) -> float:
    """The area between the bounds of envelope(samples), in the unit of the samples.

    For two samples it is their 1-Wasserstein distance.
    """
    return _core.area(_lists(samples))


def _lists(samples: Sequence[ArrayLike]) -> list[list[float]]:
    return [np.asarray(sample, dtype=np.float64).ravel().tolist() for sample in samples]
