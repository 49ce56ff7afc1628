"""The sampler from Python: right answers, same seed same bytes, errors that name the point, interrupts."""

import csv
import math
import os
import signal
import subprocess
import sys
import threading
import time
import warnings
from pathlib import Path

import numpy as np
import pytest

import tmcmc

BOX = {"a": (-3.0, 3.0), "b": (-2.0, 4.0)}
SMALL = 2600
ROOT = Path(__file__).parents[2]


def gaussian(points):
    """Mean (0.5, 1), standard deviations (0.1, 0.2), normalised: the evidence is 1 over the volume of the box."""
    z = (points - [0.5, 1.0]) / [0.1, 0.2]
    return -0.5 * np.sum(z**2, axis=1) - math.log(2.0 * math.pi * 0.1 * 0.2)


def fails_at(points, row_is_bad, failure):
    if any(row_is_bad(row) for row in points):
        failure()
    return gaussian(points)


def test_posterior_and_evidence_of_a_gaussian():
    result = tmcmc.sample(gaussian, BOX, runs=4)
    assert result.completed
    assert abs(result.log_evidence + math.log(36.0)) < 5.0 * result.log_evidence_error < 0.5
    table = result.summary()
    for name, mean, sd in (("a", 0.5, 0.1), ("b", 1.0, 0.2)):
        row = table[name]
        error = sd / math.sqrt(row["ess"])
        assert abs(row["mean"] - mean) < 5.0 * error
        assert abs(row["sd"] - sd) < 5.0 * error
        assert abs(row["50%"] - mean) < 8.0 * error
        assert abs(row["97.5%"] - (mean + 1.96 * sd)) < 15.0 * error
        assert row["r_hat"] < 1.02
    assert "r_hat" in str(table) and "97.5%" in str(table)


def test_shapes_of_a_result():
    result = tmcmc.sample(gaussian, BOX, evaluations=SMALL, runs=2)
    n = sum(len(run.samples) for run in result.runs)
    assert result.names == ["a", "b"]
    assert result.samples.shape == (n, 2)
    assert result.weights.sum() == pytest.approx(1.0)
    assert np.array_equal(result.log_likelihood, gaussian(result.samples))
    for run in result.runs:
        assert run.evaluations <= SMALL
        assert run.stages["beta"][-1] == run.beta == 1.0
        assert np.all(np.diff(run.stages["beta"]) > 0.0)
        assert len({len(column) for column in run.stages.values()}) == 1
    assert math.isnan(tmcmc.sample(gaussian, BOX, evaluations=SMALL).summary()["a"]["r_hat"])


def test_same_seed_same_bytes_and_runs_do_not_depend_on_their_number():
    first, second = (tmcmc.sample(gaussian, BOX, evaluations=SMALL, seed=7, runs=runs) for runs in (1, 2))
    assert first.runs[0].samples.tobytes() == second.runs[0].samples.tobytes()
    assert first.log_evidence == second.runs[0].log_evidence
    assert not np.array_equal(second.runs[0].samples[:50], second.runs[1].samples[:50])
    other = tmcmc.sample(gaussian, BOX, evaluations=SMALL, seed=8)
    assert not np.array_equal(first.samples[:50], other.samples[:50])


def test_the_callback_may_keep_and_change_its_points():
    kept = []

    def careless(points):
        values = gaussian(points)
        kept.append(points)
        points[:] = 0.0
        return values

    careful = tmcmc.sample(gaussian, BOX, evaluations=SMALL)
    assert tmcmc.sample(careless, BOX, evaluations=SMALL).samples.tobytes() == careful.samples.tobytes()
    assert all(np.all(points == 0.0) for points in kept)


def test_minus_infinity_excludes_points():
    result = tmcmc.sample(lambda x: np.where(x[:, 0] > 0.5, gaussian(x), -np.inf), BOX, evaluations=SMALL)
    assert result.samples[:, 0].min() > 0.5
    with pytest.raises(tmcmc.SamplingError):
        tmcmc.sample(lambda x: np.full(len(x), -np.inf), BOX, evaluations=SMALL)


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_values_that_are_no_log_likelihoods_name_the_point(value):
    with pytest.raises(tmcmc.LogLikelihoodError, match=rf"returned {value}: .* point \d+ of \d+ \(a = .*, b = ") as caught:
        tmcmc.sample(lambda x: np.where(x[:, 0] > 1.0, value, gaussian(x)), BOX, evaluations=SMALL)
    assert caught.value.point["a"] > 1.0


def test_an_exception_names_the_first_row_that_raises_it():
    def failure():
        raise ZeroDivisionError("the mesh is too coarse")

    with pytest.raises(tmcmc.LogLikelihoodError, match=r"ZeroDivisionError: the mesh .* point \d+ of \d+ \(a = ") as caught:
        tmcmc.sample(lambda x: fails_at(x, lambda row: row[0] > 2.9, failure), BOX, evaluations=SMALL)
    assert caught.value.point["a"] > 2.9
    assert isinstance(caught.value.__cause__, ZeroDivisionError)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (lambda x: gaussian(x)[:, None], r"shape \(200, 1\): expected \(200,\)"),
        (lambda x: gaussian(x)[:-1], r"shape \(199,\): expected \(200,\)"),
        (lambda x: 1.0, r"shape \(\): expected \(200,\)"),
        (lambda x: None, "NoneType|returned nan|shape"),
        (lambda x: ["abc"] * len(x), "returned list: expected 200 numbers"),
    ],
)
def test_wrong_shapes_and_types_are_told(values, message):
    with pytest.raises(tmcmc.LogLikelihoodError, match=message):
        tmcmc.sample(values, BOX, evaluations=SMALL)


def test_arguments_that_make_no_sense_are_refused():
    for prior in ({}, {"a": ("normal", 0.0)}, {"a": ("normal", 0.0, -1.0)}, {"a": ("nonsense", 1.0)}, {"a": (1.0,)}, {"a": (1.0, 1.0)}, {"a": (0.0, math.inf)}, {"a": (math.nan, 1.0)}):
        with pytest.raises(ValueError, match="prior|expected"):
            tmcmc.sample(gaussian, prior)
    with pytest.raises(TypeError, match="prior of a"):
        tmcmc.sample(gaussian, {"a": 3.0})
    with pytest.raises(ValueError, match="evaluations|budget"):
        tmcmc.sample(gaussian, BOX, evaluations=100)
    with pytest.raises(ValueError, match="runs = 0"):
        tmcmc.sample(gaussian, BOX, runs=0)


def scipy_priors():
    stats = pytest.importorskip("scipy.stats", reason="scipy is not installed (make python-deps)")
    return [
        stats.uniform(1.0, 2.0),
        stats.loguniform(0.1, 10.0),
        stats.norm(1.0, 0.5),
        stats.truncnorm(-1.0, 2.0, loc=1.0, scale=0.5),
        stats.halfnorm(scale=2.0),
        stats.lognorm(0.5, scale=2.0),
        stats.expon(scale=3.0),
        stats.gamma(2.5, scale=0.5),
        stats.invgamma(8.0, scale=3.0),
        stats.beta(2.0, 3.0, loc=-1.0, scale=4.0),
        stats.weibull_min(1.5, scale=2.0),
        stats.gumbel_r(1.0, 0.5),
        stats.t(7.0, loc=1.0, scale=0.5),
        stats.triang(0.25, loc=1.0, scale=2.0),
    ]


def test_options_of_the_sampler_by_name():
    plain = tmcmc.sample(gaussian, BOX, evaluations=SMALL)
    same = tmcmc.sample(gaussian, BOX, evaluations=SMALL, independent_fraction=np.float64(0.5), cross_fit=False, max_stages=1000)
    assert plain.samples.tobytes() == same.samples.tobytes()
    other = tmcmc.sample(gaussian, BOX, evaluations=SMALL, cross_fit=True)
    assert plain.samples.tobytes() != other.samples.tobytes()
    assert "finish" in tmcmc.options() and "chains" not in tmcmc.options()
    with pytest.raises(TypeError, match="sample\\(\\) has no option 'move_step': expected one of samples, "):
        tmcmc.sample(gaussian, BOX, move_step=3)
    with pytest.raises(ValueError, match="move_steps = 3: expected only with move = resample-move"):
        tmcmc.sample(gaussian, BOX, move_steps=3)
    with pytest.raises(ValueError, match="independent_fraction = 2.0: expected a number in "):
        tmcmc.sample(gaussian, BOX, independent_fraction=2.0)
    with pytest.raises(ValueError, match="cross_fit = maybe: expected no or yes"):
        tmcmc.sample(gaussian, BOX, cross_fit="maybe")
    with pytest.raises(TypeError, match="max_stages = None: expected a number, a text or a bool"):
        tmcmc.sample(gaussian, BOX, max_stages=None)


def test_independent_draws_have_weights_and_an_unbiased_evidence():
    calls = []

    def counted(points):
        calls.append(len(points))
        return gaussian(points)

    result = tmcmc.sample(counted, BOX, evaluations=8000, runs=2, finish="independent")
    assert abs(result.log_evidence + math.log(36.0)) < 5.0 * result.log_evidence_error < 0.1
    assert result.weights.sum() == pytest.approx(1.0) and np.ptp(result.runs[0].weights) > 0.0
    row = result.summary()["a"]
    assert abs(row["mean"] - 0.5) < 5.0 * 0.1 / math.sqrt(row["ess"])
    assert abs(row["sd"] - 0.1) < 0.01 and row["r_hat"] < 1.01
    assert sum(calls) <= 2 * 8000 and len(calls) < 200


def test_priors_of_scipy_are_those_distributions():
    """Under a likelihood of 1 the posterior is the prior, and the first stage has all samples."""
    priors = scipy_priors()
    result = tmcmc.sample(lambda x: np.zeros(len(x)), priors, evaluations=31000, finish="none")
    assert result.names == [f"x{i}" for i in range(len(priors))]
    assert result.log_evidence == pytest.approx(0.0, abs=1e-12)
    for j, prior in enumerate(priors):
        levels = prior.cdf(result.samples[:, j])
        size = result.runs[0].effective_sample_size[j]
        distance = np.max(np.abs(np.sort(levels) - np.arange(0.5, len(levels)) / len(levels)))
        assert distance < 2.5 / math.sqrt(size), prior.dist.name  # Kolmogorov: exceeded with a chance of 7e-6


def test_priors_by_name_position_and_scipy_are_the_same():
    stats = pytest.importorskip("scipy.stats", reason="scipy is not installed (make python-deps)")
    by_name = {"a": ("normal", {"mean": 0.0, "sd": 2.0}), "b": ("uniform", -2.0, 4.0)}
    by_scipy = {"a": stats.norm(scale=2.0), "b": stats.uniform(loc=-2.0, scale=6.0)}
    by_position = {"a": ("normal", 0, 2), "b": (-2, 4)}
    first, *others = (
        tmcmc.sample(gaussian, prior, evaluations=SMALL).samples.tobytes()
        for prior in (by_name, by_scipy, by_position)
    )
    assert others == [first, first]
    assert ("mean", "sd") in tmcmc.distributions()["log_normal"]
    for refused in (stats.cauchy(), stats.expon(loc=1.0), stats.norm(scale=-1.0)):
        with pytest.raises(ValueError, match="prior of a: "):
            tmcmc.sample(gaussian, {"a": refused})


def test_separate_modes_have_weights_and_means():
    """Two narrow peaks, normalised, with the shares 0.3 and 0.7."""

    def two_peaks(points):
        squares = [np.sum(((points - centre) / 0.05) ** 2, axis=1) for centre in ([-2.0, 0.0], [2.0, 1.0])]
        return np.logaddexp(math.log(0.3) - 0.5 * squares[0], math.log(0.7) - 0.5 * squares[1])

    run = tmcmc.sample(two_peaks, BOX).runs[0]
    heavy, light = run.modes
    assert abs(heavy.weight - 0.7) < 4.0 * heavy.standard_error < 0.05
    assert heavy.weight + light.weight == pytest.approx(1.0)
    assert heavy.mean == pytest.approx([2.0, 1.0], abs=0.01) and light.mean == pytest.approx([-2.0, 0.0], abs=0.01)
    assert heavy.sd == pytest.approx([0.05, 0.05], rel=0.1)
    elsewhere = (run.samples[:, 0] > 0.0) != (run.mode_of_sample == 0)
    assert np.sum(run.weights[elsewhere]) < 1e-9  # draws between the peaks
    assert heavy.samples == np.sum(run.mode_of_sample == 0)
    assert [len(modes) for modes in tmcmc.sample(gaussian, BOX, evaluations=SMALL, runs=2).modes] == [1, 1]


def test_a_budget_that_does_not_suffice_is_warned_of():
    narrow = lambda x: gaussian(x / 1e-6)
    with pytest.warns(tmcmc.SamplingWarning):
        result = tmcmc.sample(narrow, {"a": (-1e3, 1e3), "b": (-1e3, 1e3)}, evaluations=SMALL)
    assert result.completed == (result.runs[0].beta == 1.0)


def test_other_threads_run_while_the_sampler_works():
    counted = 0
    stop = threading.Event()

    def count():
        nonlocal counted
        while not stop.is_set():
            counted += 1
            time.sleep(0.0005)

    thread = threading.Thread(target=count)
    thread.start()
    tmcmc.sample(gaussian, BOX)
    stop.set()
    thread.join()
    assert counted > 5


def test_ctrl_c_ends_a_run():
    program = (
        "import sys, time, numpy as np, tmcmc\n"
        "def slow(x):\n"
        "    print('called', flush=True); time.sleep(0.02); return np.zeros(len(x))\n"
        "try: tmcmc.sample(slow, {'a': (0, 1)}, evaluations=3100000)\n"
        "except KeyboardInterrupt: print('interrupted', flush=True)\n"
    )
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "called\n"
    process.send_signal(signal.SIGINT)
    output = process.communicate(timeout=10)[0]
    assert output.endswith("interrupted\n")
    assert process.returncode == 0


def test_ctrl_c_ends_a_run_of_a_compiled_function():
    """Whose calls are short, and give Python no chance of its own to look for signals."""
    program = (
        "import functools, numpy as np, tmcmc\n"
        "print('called', flush=True)\n"
        "try: tmcmc.sample(functools.partial(np.sum, axis=1), {'a': (0, 1)}, evaluations=3000000, finish='none')\n"
        "except KeyboardInterrupt: print('interrupted', flush=True)\n"
    )
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "called\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=10)[0] == "interrupted\n"


def test_netcdf_has_the_layout_of_inference_data(tmp_path):
    xarray = pytest.importorskip("xarray", reason="xarray is not installed (make python-deps)")
    pytest.importorskip("h5netcdf", reason="h5netcdf is not installed (make python-deps)")
    result = tmcmc.sample(gaussian, BOX, evaluations=SMALL, runs=3)
    result.to_netcdf(tmp_path / "result.nc")
    draws = min(len(run.samples) for run in result.runs)
    with xarray.open_dataset(tmp_path / "result.nc", group="posterior") as posterior:
        assert dict(posterior.sizes) == {"chain": 3, "draw": draws}
        assert list(posterior.data_vars) == ["a", "b"]
        shortest = next(i for i, run in enumerate(result.runs) if len(run.samples) == draws)
        assert np.array_equal(posterior["b"].values[shortest], result.runs[shortest].samples[:, 1])
        assert posterior.attrs["log_evidence"] == result.log_evidence
    with xarray.open_dataset(tmp_path / "result.nc", group="sample_stats") as statistics:
        assert statistics["lp"].dims == ("chain", "draw")


def test_same_bytes_as_the_executable(tmp_path):
    root = Path(__file__).parents[2]
    executable = root / "build/release/bin/own_model"
    if not executable.exists():
        pytest.skip("own_model is not built (make build)")
    sys.path.insert(0, str(root / "data/examples"))
    from two_storey_frame import log_likelihood

    with (root / "data/examples/frame_observations.csv").open() as file:
        measured = [(int(row["mode"]), float(row["frequency_hz"])) for row in csv.DictReader(file)]
    with (root / "data/examples/frame_prior.csv").open() as file:
        prior = {row["parameter"]: (float(row["lower"]), float(row["upper"])) for row in csv.DictReader(file)}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", tmcmc.SamplingWarning)
        result = tmcmc.sample(lambda x: [log_likelihood(measured, *row) for row in x], prior, evaluations=SMALL, seed=3)
    worker = root / "data/examples/two_storey_worker.py"
    command = [executable, "--worker", worker, "--evaluations", str(SMALL), "--seed", "3", "--quiet"]
    subprocess.run([*command, "--output", tmp_path / "samples.csv"], check=True)
    table = np.loadtxt(tmp_path / "samples.csv", delimiter=",", skiprows=1)
    assert table[:, :-1].tobytes() == result.samples.tobytes()
    assert table[:, -1].tobytes() == result.log_likelihood.tobytes()


def bouc_wen():
    path = str(ROOT / "examples" / "bouc_wen")
    sys.path.insert(0, path)
    try:
        import bouc_wen as model
        import module as script
    finally:
        sys.path.remove(path)
    return model, script.PRIOR


@pytest.mark.parametrize("finish", ["none", "independent"])
def test_a_worker_gives_the_bytes_of_the_module(tmp_path, finish):
    executable = ROOT / "build" / "release" / "bin" / "own_model"
    if not executable.exists():
        pytest.skip("own_model is not built (make build)")
    model, prior = bouc_wen()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", tmcmc.SamplingWarning)
        result = tmcmc.sample(model.log_likelihood, prior, evaluations=2600, finish=finish)
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    problem = str(ROOT / "examples" / "bouc_wen.toml")
    options = ["--evaluations", "2600", "--finish", finish, "--quiet", "--output", str(tmp_path / "worker.csv")]
    subprocess.run([str(executable), problem, *options], check=True, env={**os.environ, "PATH": path})
    with open(tmp_path / "worker.csv") as file:
        rows = list(csv.DictReader(file))
    for j, name in enumerate(prior):
        assert [float(row[name]) for row in rows] == result.equally_weighted()[:, j].tolist()


def test_the_program_in_the_readme_runs_as_printed(tmp_path):
    readme = (Path(__file__).parents[2] / "README.md").read_text()
    program = readme.split("```python\n")[1].split("```")[0]
    assert len(program.strip().splitlines()) <= 12
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", program], capture_output=True, text=True, cwd=tmp_path, env=os.environ
    )
    assert done.returncode == 0, done.stderr
    assert "log-evidence" in done.stdout
