"""The same posterior by the Python module: module.py [samples.csv]

The samples have the bytes of `own_model examples/bouc_wen.toml`."""
import csv
import sys

import bouc_wen
import tmcmc

PRIOR = {"natural_frequency": (0.8, 1.6), "beta": (0.0, 100.0), "gamma": (-50.0, 50.0), "noise": (0.0005, 0.01)}

if __name__ == "__main__":
    result = tmcmc.sample(bouc_wen.log_likelihood, PRIOR, evaluations=31000, seed=1)
    print(result.summary())
    print(f"log-evidence {result.log_evidence:.3f} +- {result.log_evidence_error:.3f}")
    if len(sys.argv) > 1:
        with open(sys.argv[1], "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(PRIOR)
            writer.writerows(result.equally_weighted().tolist())
