"""Where the processor time of tmcmc.sample goes with a batch log-likelihood in NumPy: in it, in the sampler, which C++ would need as well,
and in what Python adds, the checks of the values.

The model is the Bouc-Wen oscillator of examples/bouc_wen. To run it: make bench-python.
"""

import sys
import time
import warnings
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "examples" / "bouc_wen"))
import bouc_wen as model  # noqa: E402
from module import PRIOR  # noqa: E402
import tmcmc  # noqa: E402
from tmcmc import _sampling  # noqa: E402


class Timed:
    """A function, and the processor time that its calls have taken."""

    def __init__(self, function):
        self.function = function
        self.seconds = 0.0

    def __call__(self, *arguments):
        start = time.process_time()
        result = self.function(*arguments)
        self.seconds += time.process_time() - start
        return result


warnings.simplefilter("ignore", tmcmc.SamplingWarning)
checked = _sampling._Batch.__call__
for evaluations in (5000, 31000):
    function, called = Timed(model.log_likelihood), Timed(checked)
    _sampling._Batch.__call__ = lambda *arguments: called(*arguments)
    start = time.process_time()
    tmcmc.sample(function, PRIOR, evaluations=evaluations)
    total = time.process_time() - start
    python = called.seconds - function.seconds
    print(
        f"{evaluations} evaluations: {total:.2f} s: log-likelihood {100 * function.seconds / total:.1f} %, "
        f"sampler {100 * (total - called.seconds) / total:.1f} %, Python besides {100 * python / total:.1f} %"
    )
