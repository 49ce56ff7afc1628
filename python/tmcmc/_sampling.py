"""The sampler."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from ._prior import marginals_of
from ._result import Result, Run, SamplingWarning

LogLikelihood = Callable[[NDArray[np.float64]], ArrayLike]


class LogLikelihoodError(RuntimeError):
    """The log-likelihood raised an exception (``__cause__``), or returned something that is no log-likelihood.

    ``point`` holds the parameters it happened at, by name.
    """

    def __init__(self, message: str, point: dict[str, float]) -> None:
        super().__init__(message)
        self.point = point


def sample(
    log_likelihood: LogLikelihood,
    prior: Mapping[str, Any] | Sequence[Any],
    *,
    evaluations: int = 31000,
    seed: int = 1,
    runs: int = 1,
    chains: int | None = None,
    **options: str | float | bool,
) -> Result:
    """Samples the posterior by waste-free TMCMC and estimates the evidence.

    Args:
        log_likelihood: called with an (n, d) array of points, a row per point and the parameters in the order of the prior;
            returns n log-likelihoods. Minus infinity excludes a point. A row's value must not depend on the other rows.
        prior: the parameters by name, each as ``(lower, upper)`` for a uniform distribution; as ``("normal", 0.0, 2.0)``, the
            name of a distribution with its arguments; as ``("log_normal", {"mean": 1.0, "sd": 0.2})``, with their names;
            or as a frozen distribution of scipy.stats. tmcmc.distributions() lists names and arguments.
            A sequence in place of the mapping gets the names x0, x1 and so on.
        evaluations: budget of log-likelihoods of a run, at least 500 and 26 a chain.
        seed: of all random numbers. The same seed gives the same samples, on any machine as far as the log-likelihood does.
        runs: number of independent runs, each with the whole budget.
        chains: of TMCMC, 100 unless given: the number of points in most of its calls of the log-likelihood. Many make the call of
            a vectorised function worth its overhead; few let the chains grow longer.
        options: options of the sampler by their names in tmcmc.options(), such as ``finish="none"`` for the last population of
            TMCMC or ``cross_fit=True``. If neither they nor chains are given, and from 3000 evaluations on, weighted independent
            draws measure the posterior (``finish="independent"``): they come in large calls and give the evidence best.

    Raises:
        LogLikelihoodError: naming the point, if the log-likelihood raises an exception or returns NaN, plus infinity or another
            number of values than points.
        SamplingError: if no draw from the prior has a finite log-likelihood.
        ValueError: for a prior, a budget or an option's value that makes no sense.
        TypeError: for an option that there is not.
    """
    given = _options(options)
    marginals = marginals_of(prior)
    names = [name for name, _, _ in marginals]
    if runs < 1:
        raise ValueError(f"runs = {runs}: expected at least 1")
    batch = _Batch(log_likelihood, names)
    results = [Run(**_core.run(batch, marginals, evaluations, chains, seed, number, given)) for number in range(runs)]
    result = Result(names, results, seed)
    for number, run in enumerate(results):
        for message in run.warnings:
            of_run = f" of run {number}" if runs > 1 else ""
            warnings.warn(f"{message}{of_run}", SamplingWarning, stacklevel=2)
    return result


def options() -> dict[str, str]:
    """The options of the sampler that sample() takes beside its own, with what each is for and the values that it has."""
    return {name: f"{text}: {expected}" for name, text, expected in _core.options() if name not in _OWN}


#: set by arguments of sample(), or of no use from Python
_OWN = ("evaluation_budget", "chains", "threads", "diagnose")


def _options(given: Mapping[str, Any]) -> dict[str, str]:
    texts = {}
    for name, value in given.items():
        if name not in options():
            raise TypeError(f"sample() has no option {name!r}: expected one of {', '.join(options())}")
        if isinstance(value, (bool, np.bool_)):
            texts[name] = "yes" if value else "no"
        elif isinstance(value, (int, np.integer)):
            texts[name] = str(int(value))
        elif isinstance(value, (float, np.floating)):
            texts[name] = repr(float(value))
        elif isinstance(value, str):
            texts[name] = value
        else:
            raise TypeError(f"{name} = {value!r}: expected a number, a text or a bool")
    return texts


class _Batch:
    """The user's function, with its results checked."""

    def __init__(self, function: LogLikelihood, names: list[str]) -> None:
        self._function = function
        self._names = names

    def __call__(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        try:
            result = self._function(points.copy(order="F"))
        except Exception as error:
            raise self._explained(points, error) from error
        try:
            values = np.asarray(result, dtype=np.float64)
        except (TypeError, ValueError):
            raise self._refusal(
                f"returned {type(result).__name__}: expected {len(points)} numbers", points[0], f"the first of {len(points)} points"
            ) from None
        if values.shape != (len(points),):
            raise self._refusal(
                f"returned an array of shape {values.shape}: expected ({len(points)},), a value for each row",
                points[0],
                f"the first of {len(points)} points",
            )
        bad = np.flatnonzero(~(values < np.inf))
        if bad.size:
            row = int(bad[0])
            raise self._refusal(
                f"returned {values[row]}: expected a number or -inf", points[row], f"point {row + 1} of {len(points)}"
            )
        return values

    def _refusal(self, what: str, point: NDArray[np.float64], which: str) -> LogLikelihoodError:
        named = dict(zip(self._names, point.tolist()))
        text = ", ".join(f"{name} = {value!r}" for name, value in named.items())
        return LogLikelihoodError(f"the log-likelihood {what}; {which} ({text})", named)

    def _explained(self, points: NDArray[np.float64], error: Exception) -> LogLikelihoodError:
        """The first row that raises an exception alone; the first of all if none does."""
        what = f"raised {type(error).__name__}: {error}"
        for row in range(len(points)):
            try:
                self._function(points[row : row + 1].copy(order="F"))
            except Exception:
                return self._refusal(what, points[row], f"point {row + 1} of {len(points)}")
        return self._refusal(what, points[0], f"the first of {len(points)} points")
