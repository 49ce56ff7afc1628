"""A Bouc-Wen oscillator under a base acceleration, for many parameter sets at a time (NumPy), and its log-likelihood.

    x'' + 2 zeta omega x' + omega^2 (alpha x + (1 - alpha) z) = -a(t)
    z'  = x' - |x'| |z| beta sign(z) - gamma x' |z|

with omega = 2 pi natural_frequency, zeta = 0.02, alpha = 0.1 (Wen 1976, exponent 1), by Runge and Kutta's second-order method (Heun).
The measurements are displacements with independent normal errors of the standard deviation `noise`, m.

Only sums, products and absolute values enter, so that the values of a point have the same bytes whatever points stand beside it."""
import csv
import math
import os

import numpy as np

PARAMETERS = ("natural_frequency", "beta", "gamma", "noise")
TIME_STEP = 0.02  # s
STEPS_PER_OBSERVATION = 10
OBSERVATIONS = 40
DAMPING_RATIO = 0.02
ELASTIC_SHARE = 0.1


def base_acceleration(step):
    """Two sines with an envelope, m/s^2."""
    t = step * TIME_STEP
    return 3.0 * math.sin(math.pi * t / 8.0) * (math.sin(2 * math.pi * 1.1 * t) + 0.6 * math.sin(2 * math.pi * 1.7 * t))


ACCELERATION = [base_acceleration(step) for step in range(OBSERVATIONS * STEPS_PER_OBSERVATION + 1)]


def displacements(natural_frequency, beta, gamma):
    """Yields the displacements, m, of one oscillator (numbers) or many (arrays) at the times of the observations."""
    omega = 2.0 * math.pi * natural_frequency
    stiffness, damping = omega * omega, 2.0 * DAMPING_RATIO * omega
    x = v = z = 0.0 * omega

    def rates(v, x, z, a):
        force = damping * v + stiffness * (ELASTIC_SHARE * x + (1.0 - ELASTIC_SHARE) * z)
        return -a - force, v - abs(v) * z * beta - v * abs(z) * gamma

    for step in range(1, OBSERVATIONS * STEPS_PER_OBSERVATION + 1):
        a, a_next = ACCELERATION[step - 1], ACCELERATION[step]
        dv, dz = rates(v, x, z, a)
        dv_next, dz_next = rates(v + TIME_STEP * dv, x + TIME_STEP * v, z + TIME_STEP * dz, a_next)
        x, v, z = (
            x + TIME_STEP * (v + 0.5 * TIME_STEP * dv),
            v + 0.5 * TIME_STEP * (dv + dv_next),
            z + 0.5 * TIME_STEP * (dz + dz_next),
        )
        if step % STEPS_PER_OBSERVATION == 0:
            yield x


def measured():
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "response.csv")
    with open(path) as file:
        return [float(row["displacement_m"]) for row in csv.DictReader(file)]


MEASURED = measured()


def log_likelihood(points):
    """Of an (n, 4) array of points, a row per point, in the order of PARAMETERS: n values."""
    points = np.asarray(points, dtype=float)
    # one point as plain numbers, which are several times faster than arrays of one element
    frequency, beta, gamma, noise = points[0].tolist() if len(points) == 1 else np.ascontiguousarray(points.T)
    misfit = 0.0
    with np.errstate(all="ignore"):
        for model, observed in zip(displacements(frequency, beta, gamma), MEASURED):
            misfit = misfit + (observed - model) * (observed - model)
    # math.log is the same for one point and for many, which NumPy's is not
    log_noise = np.array([math.log(value) for value in points[:, 3]])
    values = -0.5 * misfit / (noise * noise) - len(MEASURED) * (log_noise + 0.5 * math.log(2.0 * math.pi))
    return np.where(np.isfinite(values), values, -np.inf)
