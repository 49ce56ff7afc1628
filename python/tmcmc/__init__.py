"""Transitional Markov chain Monte Carlo: posterior samples and evidence of a model of one's own.

    import numpy as np
    import tmcmc

    def log_likelihood(points):                  # (n, d) array -> n values
        return -0.5 * np.sum((points / 0.1) ** 2, axis=1)

    result = tmcmc.sample(log_likelihood, {"a": (-1, 1), "b": (-1, 1)}, seed=1)
    print(result.summary())

The modules tmcmc.pbox and tmcmc.friction hold probability boxes and the Coulomb friction oscillator of the paper that
this library accompanies.
"""

from . import friction, pbox
from ._core import SamplingError, __version__
from ._prior import distributions
from ._result import Mode, Result, Run, SamplingWarning, Summary
from ._sampling import LogLikelihoodError, options, sample

__all__ = [
    "LogLikelihoodError",
    "Mode",
    "Result",
    "Run",
    "SamplingError",
    "SamplingWarning",
    "Summary",
    "__version__",
    "distributions",
    "friction",
    "options",
    "pbox",
    "sample",
]
