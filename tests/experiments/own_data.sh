#!/usr/bin/env bash
# A reader's own measurements: known truth is found, for other friction levels and numbers of rows.
source "$(dirname "$0")/support.sh"

# within NAME LOW VALUE HIGH
within() { check "$1: $2 <= $3 <= $4" awk -v a="$2" -v x="$3" -v b="$4" 'BEGIN {exit !(a <= x && x <= b)}'; }

for truth in 0.3 0.7 1.2; do
  for seed in 1 2; do
    "$bin/table1_observations" --friction-force $truth --seed $seed --quiet --output rows.csv
    head -n 10 rows.csv >nine.csv  # nine rows and the header
    for rows in rows nine; do
      "$bin/least_squares_baseline" --observations $rows.csv --quiet --output fit.csv
      read -r estimate error < <(awk -F, '$1=="friction_force_n" {print $2, $3}' fit.csv)
      within "least squares, $truth N, seed $seed, $rows" "$(awk "BEGIN {print $truth-4*$error}")" "$estimate" \
        "$(awk "BEGIN {print $truth+4*$error}")"
      for reading in as_published corrected; do
        "$bin/sampling_study" --observations $rows.csv --reading $reading --runs 4 --samples 500 --move-steps 10 --quiet \
          --runs-output runs.csv
        mean=$(awk -F, 'NR==1 {for (i=1;i<=NF;i++) c[$i]=i; next} {s+=$c["mean_friction_force_n"]; n++} END {print s/n}' runs.csv)
        sd=$(awk -F, 'NR==1 {for (i=1;i<=NF;i++) c[$i]=i; next} {s+=$c["sd_friction_force_n"]; n++} END {print s/n}' runs.csv)
        within "sampler, $truth N, seed $seed, $rows, $reading" "$(awk "BEGIN {print $truth-4*$sd}")" "$mean" \
          "$(awk "BEGIN {print $truth+4*$sd}")"
      done
    done
  done
done
finish
