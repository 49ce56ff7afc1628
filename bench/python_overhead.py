"""Share of the processor time of tmcmc.sample that is not spent in a batch log-likelihood in NumPy: sampler, conversions, checks.

The model is the Bouc-Wen oscillator of examples/bouc_wen. To run it: make bench-python.
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "examples" / "bouc_wen"))
import bouc_wen as model  # noqa: E402
from module import PRIOR  # noqa: E402
import tmcmc  # noqa: E402

for evaluations in (5000, 31000):
    inside = 0.0

    def timed(points):
        global inside
        start = time.process_time()
        values = model.log_likelihood(points)
        inside += time.process_time() - start
        return values

    start = time.process_time()
    tmcmc.sample(timed, PRIOR, evaluations=evaluations)
    total = time.process_time() - start
    print(f"{evaluations} evaluations: {total:.2f} s, of them {100 * (1 - inside / total):.1f} % outside the log-likelihood")
