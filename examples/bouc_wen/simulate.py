"""Writes response.csv: displacements of the oscillator of bouc_wen.py at 1.2 Hz, beta = 40, gamma = 20 1/m, with noise of 2 mm."""
import random

import bouc_wen as model

if __name__ == "__main__":
    random.seed(7)
    print("time_s,displacement_m")
    for k, x in enumerate(model.displacements(1.2, 40.0, 20.0), start=1):
        print(f"{k * model.STEPS_PER_OBSERVATION * model.TIME_STEP:.1f},{x + random.gauss(0.0, 0.002):.5f}")
