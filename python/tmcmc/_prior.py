"""Distributions of the parameters, as users state them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from . import _core

#: name of the parameter, name of the distribution, its arguments by name
Marginal = tuple[str, str, dict[str, float]]


def distributions() -> dict[str, list[tuple[str, ...]]]:
    """The distributions of a prior by name, each with the arguments that it goes by; some go by several sets of them."""
    table: dict[str, list[tuple[str, ...]]] = {}
    for name, arguments in _core.distributions():
        table.setdefault(name, []).append(tuple(arguments))
    return table


def marginals_of(prior: Mapping[str, Any] | Sequence[Any]) -> list[Marginal]:
    """The marginals of a prior as tmcmc.sample takes it, in its order; ValueError or TypeError names what is wrong."""
    if not isinstance(prior, Mapping):
        prior = {f"x{i}": marginal for i, marginal in enumerate(prior)}
    if not prior:
        raise ValueError("prior: expected at least one parameter")
    marginals = []
    for name, value in prior.items():
        try:
            distribution, arguments = _stated(value)
            marginals.append((str(name), distribution, arguments))
            _core.check_prior(marginals[-1:])
        except (TypeError, ValueError) as error:
            raise type(error)(f"prior of {name}: {error}") from None
    return marginals


def _stated(value: Any) -> tuple[str, dict[str, float]]:
    if hasattr(value, "dist") and hasattr(value, "args"):
        return _of_scipy(value)
    if isinstance(value, Sequence) and not isinstance(value, str) and len(value) > 0:
        if not isinstance(value[0], str):
            value = ("uniform", *value)
        if len(value) == 2 and isinstance(value[1], Mapping):
            return value[0], {str(key): float(number) for key, number in value[1].items()}
        return value[0], _by_position(value[0], [float(number) for number in value[1:]])
    raise TypeError(
        f"{value!r}: expected (lower, upper), the name of a distribution with its arguments, "
        "or a frozen distribution of scipy.stats"
    )


def _by_position(distribution: str, numbers: list[float]) -> dict[str, float]:
    known = distributions().get(distribution)
    if known is None:
        raise ValueError(f"distribution {distribution!r}: expected one of {', '.join(distributions())}")
    for names in known:
        if len(names) == len(numbers):
            return dict(zip(names, numbers))
    expected = " or ".join(f"({', '.join(names)})" for names in known)
    raise ValueError(f"{distribution} with {len(numbers)} arguments: expected {expected}")


#: of each distribution of scipy.stats: ours, its arguments from the shapes, loc and scale, and whether loc has to be 0
_SCIPY: dict[str, tuple[str, Callable[..., dict[str, float]], bool]] = {
    "uniform": ("uniform", lambda loc, scale: {"lower": loc, "upper": loc + scale}, False),
    "loguniform": ("log_uniform", lambda a, b, loc, scale: {"lower": a * scale, "upper": b * scale}, True),
    "norm": ("normal", lambda loc, scale: {"mean": loc, "sd": scale}, False),
    "truncnorm": (
        "truncated_normal",
        lambda a, b, loc, scale: {"mean": loc, "sd": scale, "lower": loc + a * scale, "upper": loc + b * scale},
        False,
    ),
    "halfnorm": ("half_normal", lambda loc, scale: {"sd": scale}, True),
    "lognorm": ("log_normal", lambda s, loc, scale: {"mu": math.log(scale), "sigma": s}, True),
    "expon": ("exponential", lambda loc, scale: {"rate": 1.0 / scale}, True),
    "gamma": ("gamma", lambda a, loc, scale: {"shape": a, "rate": 1.0 / scale}, True),
    "invgamma": ("inverse_gamma", lambda a, loc, scale: {"shape": a, "scale": scale}, True),
    "beta": ("beta", lambda a, b, loc, scale: {"alpha": a, "beta": b, "lower": loc, "upper": loc + scale}, False),
    "weibull_min": ("weibull", lambda c, loc, scale: {"shape": c, "scale": scale}, True),
    "gumbel_r": ("gumbel", lambda loc, scale: {"location": loc, "scale": scale}, False),
    "t": ("student_t", lambda df, loc, scale: {"degrees_of_freedom": df, "location": loc, "scale": scale}, False),
    "triang": (
        "triangular",
        lambda c, loc, scale: {"lower": loc, "mode": loc + c * scale, "upper": loc + scale},
        False,
    ),
}
_SCIPY["reciprocal"] = _SCIPY["loguniform"]


def _of_scipy(frozen: Any) -> tuple[str, dict[str, float]]:
    name = frozen.dist.name
    if name not in _SCIPY:
        raise ValueError(f"scipy.stats.{name}: expected one of {', '.join(_SCIPY)}")
    shapes, loc, scale = frozen.dist._parse_args(*frozen.args, **frozen.kwds)
    distribution, arguments_of, needs_zero_loc = _SCIPY[name]
    if needs_zero_loc and loc != 0:
        raise ValueError(f"scipy.stats.{name} with loc = {loc}: expected 0")
    arguments = arguments_of(*(float(shape) for shape in shapes), float(loc), float(scale))
    return distribution, {key: float(value) for key, value in arguments.items()}
