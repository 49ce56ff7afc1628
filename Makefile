# The pipeline: published tables -> executables -> generated tables -> figures -> replication report.
#
# Every rule runs tools/step INPUTS OUTPUTS COMMAND, which makes the outputs only if they, the inputs, the command or the sources
# of the program are not those of data/generated/manifest.csv. It compares contents, not times: hence the targets are phony.
# `make` alone lists the targets. STUDIES is the number of replicated studies; CMAKE_FLAGS are passed to CMake.

BIN := build/release/bin
GEN := data/generated
PUB := data/published
STUDIES ?= 1000
export CMAKE_FLAGS
export MAKE_GOALS := $(MAKECMDGOALS)

STEP = @tools/step "$^"
.DEFAULT_GOAL := help
.PHONY: help build all remake results figures paper compare clean README.md

#: make build       build the executables into build/release/bin
#: make all         results, figures and the replication report; what the manifest already has is not made again
#: make remake      the same from nothing but the published tables
#: make results     every generated table in data/generated
#: make figures     every figure in figures, as PDF and PNG
#: make paper       the replication report, paper/report.pdf
#: make compare     Tables 1-4 as printed beside ours, on the terminal
#: make clean       remove build/ and the results that are not committed
#: One file alone, for example: make figures/fig3_pboxes.pdf
help:
	@sed -n 's/^#: //p' $(MAKEFILE_LIST)

all: results figures paper README.md
	@tools/environment $(GEN)/environment.csv $(PACKAGES)
remake:
	$(MAKE) -B all
build:
	tools/build experiments
clean:
	rm -rf build $(GEN)/sampling_study_samples.csv

include tools/packages.mk tools/checks.mk tools/rig.mk tools/site.mk

# ---------------------------------------------------------------- results

TABLE1 := $(PUB)/table1_observations.csv
PRIOR := $(PUB)/table2_prior.csv
TABLE3 := $(PUB)/table3_pbox_area.csv
TABLE4 := $(PUB)/table4_iteration_counts.csv
PRINTED := $(TABLE1) $(PRIOR) $(TABLE3) $(TABLE4)

# Table 1 and the model: Figures 2 and 8, the deterministic fit.
AUDIT := $(addprefix $(GEN)/table1_,observations.csv audit.csv audit_summary.csv)
$(AUDIT) &: $(TABLE1)
	$(STEP) "$(AUDIT)" $(BIN)/table1_observations --observations $(TABLE1) --quiet --output $(GEN)/table1_observations.csv \
	  --audit-output $(GEN)/table1_audit.csv --audit-summary-output $(GEN)/table1_audit_summary.csv

$(GEN)/fig2_phase_angle.csv: $(TABLE1)
	$(STEP) $@ $(BIN)/fig2_phase_angle --observations $< --quiet --output $@

VALIDATION := $(addprefix $(GEN)/model_validation,.csv _errors.csv _posterior.csv)
$(VALIDATION) &: $(TABLE1) $(PRIOR)
	$(STEP) "$(VALIDATION)" $(BIN)/model_validation --observations $(TABLE1) --quiet --output $(GEN)/model_validation.csv \
	  --errors-output $(GEN)/model_validation_errors.csv --posterior-output $(GEN)/model_validation_posterior.csv

$(GEN)/least_squares_baseline.csv: $(TABLE1)
	$(STEP) $@ $(BIN)/least_squares_baseline --observations $< --quiet --output $@

# The study of the paper, 50 runs of each sampler: Tables 3 to 5, Figures 3 to 5.
STUDY := $(addprefix $(GEN)/sampling_study_,samples.csv runs.csv stages.csv)
$(STUDY) &: $(TABLE1) $(PRIOR)
	$(STEP) "$(STUDY)" $(BIN)/sampling_study --observations $(TABLE1) --quiet --output $(GEN)/sampling_study_samples.csv \
	  --runs-output $(GEN)/sampling_study_runs.csv --stages-output $(GEN)/sampling_study_stages.csv

OF_SAMPLES := $(addprefix $(GEN)/,table3_pbox_area.csv fig3_pboxes.csv table5_standard_errors.csv)
$(OF_SAMPLES): $(GEN)/%.csv: $(GEN)/sampling_study_samples.csv
	$(STEP) $@ $(BIN)/$* --input $< --quiet --output $@

$(GEN)/table4_iteration_counts.csv: $(GEN)/sampling_study_runs.csv
	$(STEP) $@ $(BIN)/table4_iteration_counts --input $< --quiet --output $@

$(GEN)/fig5_tempering.csv: $(GEN)/sampling_study_stages.csv
	$(STEP) $@ $(BIN)/fig5_tempering --input $< --quiet --output $@

$(GEN)/fig4_areas_and_iterations.csv: $(GEN)/table3_pbox_area.csv $(GEN)/table4_iteration_counts.csv $(TABLE3) $(TABLE4)
	$(STEP) $@ $(BIN)/fig4_areas_and_iterations --areas $(GEN)/table3_pbox_area.csv --counts $(GEN)/table4_iteration_counts.csv \
	  --printed-areas $(TABLE3) --printed-counts $(TABLE4) --quiet --output $@

# One sampler, its posterior and what independent draws would give, and what better moves buy: Figures 6, 7 and 12.
OF_TABLE1 := $(addprefix $(GEN)/,criterion_identity.csv endless_criterion.csv cost_accuracy.csv benchmark_problems.csv)
$(OF_TABLE1): $(GEN)/%.csv: $(TABLE1) $(PRIOR)
	$(STEP) $@ $(BIN)/$* --observations $(TABLE1) --quiet --output $@

EXACT := $(addprefix $(GEN)/exact_posterior,.csv _summary.csv _samplers.csv _marginals.csv _histograms.csv)
$(EXACT) &: $(TABLE1) $(PRIOR) $(STUDY)
	$(STEP) "$(EXACT)" $(BIN)/exact_posterior --observations $(TABLE1) --quiet --output $(GEN)/exact_posterior.csv \
	  --summary-output $(GEN)/exact_posterior_summary.csv --marginals-output $(GEN)/exact_posterior_marginals.csv \
	  --runs-input $(GEN)/sampling_study_runs.csv --samplers-output $(GEN)/exact_posterior_samplers.csv \
	  --samples-input $(GEN)/sampling_study_samples.csv --histogram-output $(GEN)/exact_posterior_histograms.csv

FLOOR := $(addprefix $(GEN)/pbox_floor,.csv _pbox.csv _summary.csv _growth.csv)
$(FLOOR) &: $(TABLE1) $(PRIOR)
	$(STEP) "$(FLOOR)" $(BIN)/pbox_floor --observations $(TABLE1) --quiet --output $(GEN)/pbox_floor.csv \
	  --pbox-output $(GEN)/pbox_floor_pbox.csv --summary-output $(GEN)/pbox_floor_summary.csv --growth-output $(GEN)/pbox_floor_growth.csv

# Replicated studies, the verdicts, the readings, other settings: Figures 9 to 11, 14. A study that was stopped goes on from its journal.
$(GEN)/replicated_study.csv: $(TABLE1) $(PRIOR)
	$(STEP) $@ $(BIN)/replicated_study --observations $(TABLE1) --studies $(STUDIES) --quiet --output $@

VERDICTS := $(addprefix $(GEN)/,verdicts.csv verdicts.md contrasts.csv verdict_statistics.csv)
$(VERDICTS) &: $(GEN)/replicated_study.csv $(GEN)/sampling_study_runs.csv $(GEN)/pbox_floor.csv $(PUB)/claims.csv $(PRINTED)
	$(STEP) "$(VERDICTS)" $(BIN)/verdicts --observations $(TABLE1) --replicated $(GEN)/replicated_study.csv \
	  --claims $(PUB)/claims.csv --table3 $(TABLE3) --table4 $(TABLE4) --quiet --output $(GEN)/verdicts.csv \
	  --markdown-output $(GEN)/verdicts.md --contrasts-output $(GEN)/contrasts.csv --statistics-output $(GEN)/verdict_statistics.csv

NULL := $(addprefix $(GEN)/fig9_null_distributions,.csv _counts.csv _printed.csv _pairs.csv)
$(NULL) &: $(GEN)/replicated_study.csv $(PRINTED)
	$(STEP) "$(NULL)" $(BIN)/fig9_null_distributions --replicated $(GEN)/replicated_study.csv --table3 $(TABLE3) \
	  --table4 $(TABLE4) --quiet --output $(GEN)/fig9_null_distributions.csv \
	  --counts-output $(GEN)/fig9_null_distributions_counts.csv --printed-output $(GEN)/fig9_null_distributions_printed.csv \
	  --pairs-output $(GEN)/fig9_null_distributions_pairs.csv

$(GEN)/readings.csv: $(PRINTED)
	$(STEP) $@ $(BIN)/readings --observations $(TABLE1) --quiet --output $@

FORENSICS := $(addprefix $(GEN)/forensics,.csv _pairs.csv _summary.csv)
$(FORENSICS) &: $(GEN)/replicated_study.csv $(PRINTED)
	$(STEP) "$(FORENSICS)" $(BIN)/forensics --observations $(TABLE1) --replicated $(GEN)/replicated_study.csv --quiet \
	  --output $(GEN)/forensics.csv --pairs-output $(GEN)/forensics_pairs.csv --summary-output $(GEN)/forensics_summary.csv

# Whether better moves are calibrated, and what the prior of the noise levels does: Figures 13 and 15.
CALIBRATION := $(GEN)/calibration.csv $(GEN)/calibration_ranks.csv
$(CALIBRATION) &: $(TABLE1) $(PRIOR)
	$(STEP) "$(CALIBRATION)" $(BIN)/calibration --observations $(TABLE1) --quiet --output $(GEN)/calibration.csv \
	  --ranks-output $(GEN)/calibration_ranks.csv

SENSITIVITY := $(addprefix $(GEN)/prior_sensitivity,.csv _pbox.csv)
$(SENSITIVITY) &: $(TABLE1) $(PRIOR)
	$(STEP) "$(SENSITIVITY)" $(BIN)/prior_sensitivity --observations $(TABLE1) --quiet --output $(GEN)/prior_sensitivity.csv \
	  --pbox-output $(GEN)/prior_sensitivity_pbox.csv

# Printed beside ours.
COMPARISON := $(addprefix $(GEN)/compare_published,.csv .md .txt)
$(COMPARISON) &: $(GEN)/replicated_study.csv $(GEN)/table1_observations.csv $(GEN)/table3_pbox_area.csv $(GEN)/table4_iteration_counts.csv \
  $(PRINTED)
	$(STEP) "$(COMPARISON)" $(BIN)/compare_published --published $(PUB) --replicated $(GEN)/replicated_study.csv \
	  --table1 $(GEN)/table1_observations.csv --table3 $(GEN)/table3_pbox_area.csv --table4 $(GEN)/table4_iteration_counts.csv \
	  --quiet --output $(GEN)/compare_published.csv --markdown-output $(GEN)/compare_published.md \
	  --text-output $(GEN)/compare_published.txt

compare: $(GEN)/compare_published.txt
	@cat $<

RESULTS := $(AUDIT) $(GEN)/fig2_phase_angle.csv $(VALIDATION) $(GEN)/least_squares_baseline.csv $(STUDY) $(OF_SAMPLES) \
  $(GEN)/table4_iteration_counts.csv $(GEN)/fig5_tempering.csv $(GEN)/fig4_areas_and_iterations.csv $(OF_TABLE1) $(EXACT) \
  $(FLOOR) $(GEN)/replicated_study.csv $(VERDICTS) $(NULL) $(GEN)/readings.csv $(FORENSICS) $(CALIBRATION) \
  $(SENSITIVITY) $(COMPARISON)
results: $(RESULTS)

# ---------------------------------------------------------------- figures, each of its script and of the tables named here

FIGURES := $(patsubst figures/%.gp,figures/%.pdf,$(wildcard figures/fig*.gp))
figures: $(FIGURES)

$(FIGURES): figures/%.pdf: figures/%.gp figures/style.gp figures/draw
	$(STEP) "$@ figures/$*.png" figures/draw $* $(GEN) figures
$(FIGURES:.pdf=.png): %.png: %.pdf

figures/fig2_phase_angle.pdf: $(GEN)/fig2_phase_angle.csv $(TABLE1)
figures/fig3_pboxes.pdf: $(GEN)/fig3_pboxes.csv $(GEN)/least_squares_baseline.csv
figures/fig4_areas_and_iterations.pdf: $(GEN)/fig4_areas_and_iterations.csv $(GEN)/compare_published.csv
figures/fig5_tempering.pdf: $(GEN)/fig5_tempering.csv
figures/fig6_exact_posterior.pdf: $(addprefix $(GEN)/,exact_posterior_marginals.csv exact_posterior_histograms.csv least_squares_baseline.csv)
figures/fig7_pbox_floor.pdf: $(GEN)/pbox_floor_pbox.csv $(GEN)/fig3_pboxes.csv
figures/fig8_model_validation.pdf: $(GEN)/model_validation.csv $(GEN)/model_validation_errors.csv
figures/fig9_null_distributions.pdf: $(addprefix $(GEN)/fig9_null_distributions,.csv _printed.csv _pairs.csv)
figures/fig10_iteration_tables.pdf: $(GEN)/fig9_null_distributions_counts.csv
figures/fig11_readings.pdf: $(GEN)/readings.csv $(TABLE3)
figures/fig12_cost_accuracy.pdf: $(GEN)/cost_accuracy.csv $(GEN)/pbox_floor_growth.csv
figures/fig13_calibration.pdf: figures/distinct.gp $(GEN)/calibration_ranks.csv
figures/fig14_forensics.pdf: $(GEN)/forensics_pairs.csv
figures/fig15_prior_sensitivity.pdf: $(GEN)/prior_sensitivity_pbox.csv
figures/fig16_arena.pdf: figures/distinct.gp $(GEN)/benchmark_problems.csv

# ---------------------------------------------------------------- replication report, and the tables in the README

# Every number in the report comes from the tables above, through the lists paper/values.csv and paper/tables.csv.
LISTS := $(addprefix paper/,values.csv tables.csv measured.csv equations.csv)
paper/generated/values.tex: tools/report_values $(LISTS) $(RESULTS) $(PRINTED) $(PUB)/stated_values.csv
	$(STEP) $@ tools/report_values $@

TEXT := $(addprefix paper/,report.tex macros.tex references.bib constants.txt) $(wildcard paper/sections/*.tex)
paper/report.pdf: paper/generated/values.tex $(TEXT) $(LISTS) $(FIGURES) tools/check_report tools/build_report
	@tools/check_report paper
	$(STEP) $@ tools/build_report paper/generated figures $@

paper: paper/report.pdf
README.md: $(GEN)/compare_published.md $(GEN)/verdicts.md
	@tools/splice $@ $^

.PHONY: $(RESULTS) $(FIGURES) $(FIGURES:.pdf=.png) paper/generated/values.tex paper/report.pdf
build all $(RESULTS) $(FIGURES): | $(filter deps,$(MAKECMDGOALS))
