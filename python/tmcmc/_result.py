"""What a call of tmcmc.sample returns."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core

Array = NDArray[np.float64]
QUANTILES = (0.025, 0.25, 0.5, 0.75, 0.975)


class SamplingWarning(UserWarning):
    """A run that should not be believed without a second look."""


@dataclass(frozen=True)
class Mode:
    """A separate mode of a posterior: a part with next to no samples between it and the others."""

    weight: float  #: posterior probability
    standard_error: float  #: of the weight
    samples: int  #: in it
    mean: Array  #: of its samples, d
    sd: Array  #: of its samples, d


@dataclass(frozen=True)
class Run:
    """One run of the sampler."""

    samples: Array  #: (n, d), a row per sample
    log_likelihood: Array  #: n
    weights: Array  #: of the samples, n, which sum to 1; equal but with finish="independent"
    log_evidence: float  #: with the prior normalised
    log_evidence_error: float  #: standard error, from this run alone
    effective_sample_size: Array  #: of each parameter, d
    stages: dict[str, Any]  #: an array a quantity, with an entry a stage
    warnings: list[str]  #: empty for a run that looks healthy
    beta: float  #: 1 unless the budget did not suffice: then the samples are not those of the posterior
    evaluations: int  #: log-likelihoods that were computed
    stop: str  #: why the run ended
    chains: int  #: sample i belongs to chain i modulo this
    parents: list[list[int]]  #: [t][c]: chain after stage t from which chain c after stage t + 1 started

    @property
    def modes(self) -> list[Mode]:
        """The separate modes, at least one, the heaviest first; a mode that the run has missed is not among them."""
        return self._modes[0]

    @property
    def mode_of_sample(self) -> NDArray[np.intp]:
        """The place of each sample's mode in modes, n."""
        return self._modes[1]

    @cached_property
    def _modes(self) -> tuple[list[Mode], NDArray[np.intp]]:
        found, of_sample, messages = _core.find_modes(self.samples, self.weights, self.chains, self.parents)
        for message in messages:
            warnings.warn(message, SamplingWarning, stacklevel=4)
        return [Mode(**mode) for mode in found], of_sample

    def _equal_draws(self) -> int:
        if np.ptp(self.weights) == 0.0:
            return len(self.weights)
        return max(1, round(float(np.sum(self.weights)) ** 2 / float(np.sum(self.weights**2))))

    def _equal_rows(self, draws: int) -> NDArray[np.intp]:
        sums = np.cumsum(self.weights)
        rows = np.searchsorted(sums, (np.arange(draws) + 0.5) * (sums[-1] / draws), side="right")
        return np.minimum(rows, len(sums) - 1)


class Summary(dict[str, dict[str, float]]):
    """Statistics by name for each parameter; prints as a table."""

    def __str__(self) -> str:
        columns = list(next(iter(self.values())))
        width = max(len("parameter"), *(len(name) for name in self))
        lines = [" ".join([f"{'parameter':<{width}}", *(f"{column:>10}" for column in columns)])]
        for name, row in self.items():
            lines.append(" ".join([f"{name:<{width}}", *(f"{row[column]:>10.4g}" for column in columns)]))
        return "\n".join(lines)


@dataclass(frozen=True)
class Result:
    """Samples, evidence and diagnostics of all runs."""

    names: list[str]  #: of the parameters, d
    runs: list[Run]  #: in their order
    seed: int

    @property
    def samples(self) -> Array:
        """Samples of all runs, (n, d)."""
        return np.concatenate([run.samples for run in self.runs])

    @property
    def weights(self) -> Array:
        """Weights of the samples, which sum to 1: each run counts the same."""
        return np.concatenate([run.weights / len(self.runs) for run in self.runs])

    def equally_weighted(self) -> Array:
        """Samples of all runs with equal weights, (n, d): as many as the weighted ones are worth, evenly spaced in the sum of the
        weights; all if the weights are equal. Their bytes are those of the file that own_model writes."""
        return np.concatenate([run.samples[run._equal_rows(run._equal_draws())] for run in self.runs])

    @property
    def log_likelihood(self) -> Array:
        """Log-likelihoods of the samples."""
        return np.concatenate([run.log_likelihood for run in self.runs])

    @property
    def log_evidence(self) -> float:
        """Mean over the runs."""
        return float(np.mean([run.log_evidence for run in self.runs]))

    @property
    def log_evidence_error(self) -> float:
        """Standard error of log_evidence: from the runs' own errors or from the scatter between them, whichever is larger."""
        count = len(self.runs)
        within = float(np.sqrt(np.sum([run.log_evidence_error**2 for run in self.runs]))) / count
        if count == 1:
            return within
        return max(within, float(np.std([run.log_evidence for run in self.runs], ddof=1)) / count**0.5)

    @property
    def modes(self) -> list[list[Mode]]:
        """The separate modes of each run: one for a posterior of one piece, whatever its shape."""
        return [run.modes for run in self.runs]

    @property
    def stages(self) -> list[dict[str, Any]]:
        """The stages of each run."""
        return [run.stages for run in self.runs]

    @property
    def completed(self) -> bool:
        """Whether all runs reached the posterior."""
        return all(run.beta == 1.0 for run in self.runs)

    def summary(self) -> Summary:
        """Mean, sd, quantiles, effective sample size (ess) and R-hat between the runs (nan for one run) of each parameter."""
        weights, samples = self.weights, self.samples
        table = Summary()
        for j, name in enumerate(self.names):
            x = samples[:, j]
            order = np.argsort(x, kind="stable")
            # the middle of each sample's step of the weighted distribution function
            level = np.cumsum(weights[order]) - 0.5 * weights[order]
            mean = float(np.sum(weights * x))
            row = {"mean": mean, "sd": float(np.sqrt(np.sum(weights * (x - mean) ** 2)))}
            row |= {f"{100 * q:g}%": float(np.interp(q, level, x[order])) for q in QUANTILES}
            row["ess"] = float(sum(run.effective_sample_size[j] for run in self.runs))
            row["r_hat"] = self._r_hat(j)
            table[name] = row
        return table

    def _r_hat(self, j: int) -> float:
        """Gelman and Rubin (1992), with runs in the place of chains and effective samples in that of draws."""
        if len(self.runs) == 1:
            return float("nan")
        n = float(np.mean([run.effective_sample_size[j] for run in self.runs]))
        means = [float(np.sum(run.weights * run.samples[:, j])) for run in self.runs]
        within = float(np.mean([np.sum(run.weights * (run.samples[:, j] - m) ** 2) for run, m in zip(self.runs, means)]))
        between = float(np.var(means, ddof=1))
        return float(np.sqrt((n - 1.0) / n + between / within)) if within > 0.0 else float("nan")

    def to_xarray(self) -> dict[str, Any]:
        """The groups posterior and sample_stats in the layout of ArviZ's InferenceData, as xarray.Dataset; runs are chains.

        Chains have the length of the shortest run and equal weights, as those of equally_weighted().
        """
        try:
            import xarray
        except ImportError as error:
            raise ImportError("to_xarray and to_netcdf need xarray (Debian: python3-xarray)") from error
        length = min(run._equal_draws() for run in self.runs)
        rows = [run._equal_rows(length) for run in self.runs]
        coordinates = {"chain": np.arange(len(self.runs)), "draw": np.arange(length)}
        attributes = {
            "inference_library": "tmcmc_companion",
            "inference_library_version": _core.__version__,
            "seed": str(self.seed),
            "log_evidence": self.log_evidence,
            "log_evidence_standard_error": self.log_evidence_error,
        }

        def dataset(columns: dict[str, list[Array]]) -> Any:
            variables = {name: (("chain", "draw"), np.stack(values)) for name, values in columns.items()}
            return xarray.Dataset(variables, coordinates, attributes)

        return {
            "posterior": dataset(
                {name: [run.samples[r, j] for run, r in zip(self.runs, rows)] for j, name in enumerate(self.names)}
            ),
            "sample_stats": dataset({"lp": [run.log_likelihood[r] for run, r in zip(self.runs, rows)]}),
        }

    def to_netcdf(self, path: str | PathLike[str]) -> None:
        """Writes to_xarray() to a NetCDF file that arviz.from_netcdf reads; needs h5netcdf or netCDF4."""
        mode = "w"
        for group, dataset in self.to_xarray().items():
            dataset.to_netcdf(path, mode=mode, group=group, engine=_engine())
            mode = "a"


def _engine() -> str:
    for engine, module in (("netcdf4", "netCDF4"), ("h5netcdf", "h5netcdf")):
        try:
            __import__(module)
        except ImportError:
            continue
        return engine
    raise ImportError("to_netcdf needs h5netcdf (Debian: python3-h5netcdf) or netCDF4 (python3-netcdf4)")
