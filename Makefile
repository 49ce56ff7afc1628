# The pipeline: published tables -> executables -> generated CSV -> figures and comparison.
# `make` prints the targets; variables that may be set: directories of the outputs (GEN, FIG, PAPER), CMAKE_FLAGS.

BUILD := build/release
BIN := $(BUILD)/bin
GEN ?= data/generated
FIG ?= figures
PAPER ?= paper
PUB := data/published
CMAKE_FLAGS ?=

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help deps build all results figures paper compare test verify verify-parts another-seed identical bench scaling install doc-deps docs \
  fuzz mpi-deps reader-deps build-mpi test-mpi bench-mpi sanitize sanitize-deps tidy coverage coverage-deps mutations check-manifest clean
.SECONDARY:

help:
	@echo 'make deps      install the Debian packages that are missing (root or sudo only if there are any)'
	@echo 'make build     build the executables into $(BIN)'
	@echo 'make all       results, figures and the replication report'
	@echo 'make results   every generated table in $(GEN)'
	@echo 'make figures   every figure in $(FIG), as PDF and PNG'
	@echo 'make paper     the replication report, $(PAPER)/report.pdf'
	@echo 'make compare   Tables 1-4 as printed beside ours, on the terminal'
	@echo 'make test      build and run the tests'
	@echo 'make verify    check the manifest; regenerate everything into build/verify and compare with the committed files'
	@echo 'make verify-parts  the same in two minutes: of the four studies that take minutes each, parts'
	@echo 'make check-manifest  the committed files against the hashes of the manifest, in a second'
	@echo 'make sanitize  the whole test suite with the address, undefined-behaviour and thread sanitizers'
	@echo 'make tidy      clang-tidy over src, experiments and bench'
	@echo 'make coverage  lines of src/ that the tests run'
	@echo 'make mutations deliberate faults in src/, and which test sees each (half an hour)'
	@echo 'make another-seed  replicated studies with SEED=2, and whether every verdict is the same'
	@echo 'make identical build with other compilers and instruction sets and compare the bytes of the samples'
	@echo 'make fuzz      libFuzzer on the CSV reader and the command line, $(FUZZ_SECONDS) s each, with sanitizers'
	@echo 'make bench     measure speed (Google Benchmark)'
	@echo 'make build-mpi  replicated_study for mpirun, into build/mpi/bin (OpenMPI is installed if missing); docs/clusters.md'
	@echo 'make test-mpi  the same and its tests;  make bench-mpi  a batch of a slow model on one and two ranks'
	@echo 'make scaling   measure time and memory over samples, threads and observations, with figure, into $(SCALING)'
	@echo 'make install   install the libraries, their headers and the CMake package into $(PREFIX) (PREFIX=...)'
	@echo 'make docs      API reference by Doxygen, build/docs/html/index.html'
	@echo 'make clean     remove build/ and what is not committed'
	@echo 'One file, e.g.: make figures/fig3_pboxes.pdf'

# ---------------------------------------------------------------- packages

PACKAGES := g++ cmake ninja-build libeigen3-dev libboost-dev libceres-dev librandom123-dev libfmt-dev libcli11-dev \
  catch2 libbenchmark-dev libnetcdf-dev netcdf-bin python3-minimal procps gnuplot-nox fonts-urw-base35 fontconfig poppler-utils \
  texlive-latex-recommended texlive-fonts-recommended

doc-deps: PACKAGES := doxygen
sanitize-deps: PACKAGES := clang clang-tidy libclang-rt-14-dev libomp-dev
coverage-deps: PACKAGES := gcovr
mpi-deps: PACKAGES := libopenmpi-dev openmpi-bin
reader-deps: PACKAGES := python3-xarray python3-h5netcdf
deps doc-deps sanitize-deps coverage-deps mpi-deps reader-deps:
	@missing=$$(for p in $(PACKAGES); do \
	  dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || echo $$p; done); \
	if [ -n "$$missing" ]; then \
	  echo "installing" $$missing; \
	  if [ "$$(id -u)" = 0 ]; then as_root=env; else as_root='sudo env'; fi; \
	  $$as_root apt-get update -qq && \
	  $$as_root DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing; \
	fi

# ---------------------------------------------------------------- executables

EXPERIMENTS := $(patsubst experiments/%.cpp,%,$(wildcard experiments/*.cpp))
LIBRARY_SOURCES := $(shell find src -name '*.[ch]pp' -o -name CMakeLists.txt) CMakeLists.txt CMakePresets.json \
  experiments/CMakeLists.txt $(wildcard experiments/support/*)
EXECUTABLES := $(addprefix $(BIN)/,$(EXPERIMENTS))

build: $(EXECUTABLES)

# One call of CMake builds them all; each executable then depends on its own source and the libraries alone.
$(BUILD)/.built: $(LIBRARY_SOURCES) $(EXPERIMENTS:%=experiments/%.cpp)
	@mkdir -p build
	cmake --preset release $(CMAKE_FLAGS) >$(BUILD).configure.log 2>&1 || { cat $(BUILD).configure.log; false; }
	cmake --build --preset release --target experiments
	@touch $@

$(EXECUTABLES): $(BIN)/%: experiments/%.cpp $(LIBRARY_SOURCES) | $(BUILD)/.built
	@test -x $@ || cmake --build --preset release --target $*
	@touch $@

ifneq ($(filter deps,$(MAKECMDGOALS)),)
$(BUILD)/.built: | deps
endif

# ---------------------------------------------------------------- results

TABLE1 := $(PUB)/table1_observations.csv
PRIOR := $(PUB)/table2_prior.csv
PRINTED := $(addprefix $(PUB)/,table1_observations.csv table2_prior.csv table3_pbox_area.csv table4_iteration_counts.csv)
STUDY := $(addprefix $(GEN)/sampling_study_,samples.csv runs.csv stages.csv)

RESULTS := $(addprefix $(GEN)/,table1_observations.csv table1_audit.csv fig2_phase_angle.csv \
  sampling_study_runs.csv sampling_study_stages.csv table3_pbox_area.csv fig3_pboxes.csv fig4_areas_and_iterations.csv \
  table4_iteration_counts.csv fig5_tempering.csv table5_standard_errors.csv criterion_identity.csv \
  least_squares_baseline.csv compare_published.csv compare_published.md \
  replicated_study.csv readings.csv endless_criterion.csv verdicts.csv verdicts.md contrasts.csv fig9_null_distributions.csv \
  fig9_null_distributions_counts.csv fig9_null_distributions_printed.csv)
RESULTS += $(addprefix $(GEN)/,table1_audit_summary.csv exact_posterior.csv exact_posterior_summary.csv \
  exact_posterior_samplers.csv exact_posterior_marginals.csv exact_posterior_histograms.csv pbox_floor.csv \
  pbox_floor_pbox.csv pbox_floor_summary.csv model_validation.csv model_validation_errors.csv model_validation_posterior.csv \
  cost_accuracy.csv calibration.csv calibration_ranks.csv benchmark_problems.csv)

results: $(RESULTS)

$(GEN)/. $(FIG)/.:
	mkdir -p $@

$(addprefix $(GEN)/,table1_observations.csv table1_audit.csv table1_audit_summary.csv) &: \
  $(BIN)/table1_observations $(TABLE1) | $(GEN)/.
	$< --observations $(TABLE1) --quiet --output $(GEN)/table1_observations.csv \
	  --audit-output $(GEN)/table1_audit.csv --audit-summary-output $(GEN)/table1_audit_summary.csv

$(GEN)/fig2_phase_angle.csv: $(BIN)/fig2_phase_angle | $(GEN)/.
	$< --quiet --output $@

$(STUDY) &: $(BIN)/sampling_study $(TABLE1) $(PRIOR) | $(GEN)/.
	$< --observations $(TABLE1) --quiet --output $(GEN)/sampling_study_samples.csv \
	  --runs-output $(GEN)/sampling_study_runs.csv --stages-output $(GEN)/sampling_study_stages.csv

$(GEN)/table3_pbox_area.csv: $(BIN)/table3_pbox_area $(GEN)/sampling_study_samples.csv
	$< --input $(GEN)/sampling_study_samples.csv --quiet --output $@

$(GEN)/fig3_pboxes.csv: $(BIN)/fig3_pboxes $(GEN)/sampling_study_samples.csv
	$< --input $(GEN)/sampling_study_samples.csv --quiet --output $@

$(GEN)/table4_iteration_counts.csv: $(BIN)/table4_iteration_counts $(GEN)/sampling_study_runs.csv
	$< --input $(GEN)/sampling_study_runs.csv --quiet --output $@

$(GEN)/fig4_areas_and_iterations.csv: $(BIN)/fig4_areas_and_iterations $(GEN)/table3_pbox_area.csv \
  $(GEN)/table4_iteration_counts.csv $(PUB)/table3_pbox_area.csv $(PUB)/table4_iteration_counts.csv
	$< --areas $(GEN)/table3_pbox_area.csv --counts $(GEN)/table4_iteration_counts.csv \
	  --printed-areas $(PUB)/table3_pbox_area.csv --printed-counts $(PUB)/table4_iteration_counts.csv --quiet --output $@

$(GEN)/fig5_tempering.csv: $(BIN)/fig5_tempering $(GEN)/sampling_study_stages.csv
	$< --input $(GEN)/sampling_study_stages.csv --quiet --output $@

$(GEN)/table5_standard_errors.csv: $(BIN)/table5_standard_errors $(GEN)/sampling_study_samples.csv
	$< --input $(GEN)/sampling_study_samples.csv --quiet --output $@

$(GEN)/criterion_identity.csv: $(BIN)/criterion_identity $(TABLE1) $(PRIOR) | $(GEN)/.
	$< --observations $(TABLE1) --quiet --output $@

$(GEN)/least_squares_baseline.csv: $(BIN)/least_squares_baseline $(TABLE1) | $(GEN)/.
	$< --observations $(TABLE1) --quiet --output $@

EXACT := $(addprefix $(GEN)/exact_posterior,.csv _summary.csv _samplers.csv _marginals.csv _histograms.csv)

$(EXACT) &: $(BIN)/exact_posterior $(TABLE1) $(PRIOR) $(STUDY)
	$< --observations $(TABLE1) --quiet --output $(GEN)/exact_posterior.csv \
	  --summary-output $(GEN)/exact_posterior_summary.csv --marginals-output $(GEN)/exact_posterior_marginals.csv \
	  --runs-input $(GEN)/sampling_study_runs.csv --samplers-output $(GEN)/exact_posterior_samplers.csv \
	  --samples-input $(GEN)/sampling_study_samples.csv --histogram-output $(GEN)/exact_posterior_histograms.csv

$(addprefix $(GEN)/pbox_floor,.csv _pbox.csv _summary.csv) &: $(BIN)/pbox_floor $(TABLE1) $(PRIOR) | $(GEN)/.
	$< --observations $(TABLE1) --quiet --output $(GEN)/pbox_floor.csv --pbox-output $(GEN)/pbox_floor_pbox.csv \
	  --summary-output $(GEN)/pbox_floor_summary.csv

VALIDATION := $(addprefix $(GEN)/model_validation,.csv _errors.csv _posterior.csv)

$(VALIDATION) &: $(BIN)/model_validation $(TABLE1) $(PRIOR) | $(GEN)/.
	$< --observations $(TABLE1) --quiet --output $(GEN)/model_validation.csv \
	  --errors-output $(GEN)/model_validation_errors.csv --posterior-output $(GEN)/model_validation_posterior.csv

# Replicated studies: STUDIES of 50 runs of each sampler. A build that was stopped goes on from the journal.
STUDIES ?= 1000

$(GEN)/replicated_study.csv: $(BIN)/replicated_study $(TABLE1) $(PRIOR) | $(GEN)/.
	$< --observations $(TABLE1) --studies $(STUDIES) --quiet --output $@

$(GEN)/readings.csv: $(BIN)/readings $(PRINTED) | $(GEN)/.
	$< --observations $(TABLE1) --quiet --output $@

$(GEN)/endless_criterion.csv: $(BIN)/endless_criterion $(TABLE1) $(PRIOR) | $(GEN)/.
	$< --observations $(TABLE1) --quiet --output $@

$(addprefix $(GEN)/,verdicts.csv verdicts.md contrasts.csv) &: $(BIN)/verdicts $(GEN)/replicated_study.csv $(PUB)/claims.csv $(PRINTED)
	$< --observations $(TABLE1) --replicated $(GEN)/replicated_study.csv --claims $(PUB)/claims.csv \
	  --table3 $(PUB)/table3_pbox_area.csv --table4 $(PUB)/table4_iteration_counts.csv \
	  --quiet --output $(GEN)/verdicts.csv --markdown-output $(GEN)/verdicts.md \
	  --contrasts-output $(GEN)/contrasts.csv

NULL := $(addprefix $(GEN)/fig9_null_distributions,.csv _counts.csv _printed.csv)

$(NULL) &: $(BIN)/fig9_null_distributions $(GEN)/replicated_study.csv $(PRINTED)
	$< --replicated $(GEN)/replicated_study.csv --table3 $(PUB)/table3_pbox_area.csv \
	  --table4 $(PUB)/table4_iteration_counts.csv --quiet --output $(GEN)/fig9_null_distributions.csv \
	  --counts-output $(GEN)/fig9_null_distributions_counts.csv --printed-output $(GEN)/fig9_null_distributions_printed.csv

$(GEN)/cost_accuracy.csv: $(BIN)/cost_accuracy $(TABLE1) $(PRIOR) | $(GEN)/.
	$< --observations $(TABLE1) --quiet --output $@

$(GEN)/calibration.csv $(GEN)/calibration_ranks.csv &: $(BIN)/calibration $(TABLE1) $(PRIOR) | $(GEN)/.
	$< --observations $(TABLE1) --quiet --output $(GEN)/calibration.csv --ranks-output $(GEN)/calibration_ranks.csv

$(GEN)/benchmark_problems.csv: $(BIN)/benchmark_problems | $(GEN)/.
	$< --quiet --output $@

COMPARED := $(GEN)/replicated_study.csv $(GEN)/table1_observations.csv $(GEN)/table3_pbox_area.csv $(GEN)/table4_iteration_counts.csv
COMPARE = $(BIN)/compare_published --published $(PUB) --replicated $(GEN)/replicated_study.csv --table1 $(GEN)/table1_observations.csv \
  --table3 $(GEN)/table3_pbox_area.csv --table4 $(GEN)/table4_iteration_counts.csv

$(GEN)/compare_published.csv $(GEN)/compare_published.md &: $(BIN)/compare_published $(COMPARED) $(PRINTED)
	$(COMPARE) --quiet --output $(GEN)/compare_published.csv --markdown-output $(GEN)/compare_published.md

compare: $(BIN)/compare_published $(COMPARED) $(PRINTED)
	@$(COMPARE)

# ---------------------------------------------------------------- figures

FIGURES := fig1_rig fig2_phase_angle fig3_pboxes fig4_areas_and_iterations fig5_tempering \
  fig6_exact_posterior fig7_pbox_floor fig8_model_validation \
  fig9_null_distributions fig10_iteration_tables fig11_readings fig12_cost_accuracy fig13_calibration
FIGURE_FILES := $(foreach f,$(FIGURES),$(FIG)/$(f).pdf $(FIG)/$(f).png)

figures: $(FIGURE_FILES)

DATA_fig1_rig :=
DATA_fig2_phase_angle := $(GEN)/fig2_phase_angle.csv $(TABLE1)
DATA_fig3_pboxes := $(GEN)/fig3_pboxes.csv $(GEN)/least_squares_baseline.csv
DATA_fig4_areas_and_iterations := $(GEN)/fig4_areas_and_iterations.csv
DATA_fig5_tempering := $(GEN)/fig5_tempering.csv
DATA_fig6_exact_posterior := $(addprefix $(GEN)/,exact_posterior_marginals.csv exact_posterior_histograms.csv \
  least_squares_baseline.csv)
DATA_fig7_pbox_floor := $(GEN)/pbox_floor_pbox.csv $(GEN)/fig3_pboxes.csv
DATA_fig8_model_validation := $(GEN)/model_validation.csv $(GEN)/model_validation_errors.csv
DATA_fig9_null_distributions := $(GEN)/fig9_null_distributions.csv $(GEN)/fig9_null_distributions_printed.csv
DATA_fig10_iteration_tables := $(GEN)/fig9_null_distributions_counts.csv
DATA_fig12_cost_accuracy := $(GEN)/cost_accuracy.csv $(GEN)/pbox_floor_summary.csv $(PUB)/table3_pbox_area.csv
DATA_fig13_calibration := $(GEN)/calibration_ranks.csv
DATA_fig11_readings := $(GEN)/readings.csv $(PUB)/table3_pbox_area.csv

define figure_rule
$(FIG)/$(1).pdf $(FIG)/$(1).png &: figures/$(1).gp figures/style.gp figures/draw $(DATA_$(1)) | $(FIG)/.
	figures/draw $(1) $(GEN) $(FIG)
endef
$(foreach f,$(FIGURES),$(eval $(call figure_rule,$(f))))

# ---------------------------------------------------------------- replication report

# Every number in the report comes from the tables above, through the lists paper/values.csv and paper/tables.csv.
VALUES := $(PAPER)/generated/values.tex
REPORT := $(PAPER)/report.pdf
REPORT_LISTS := $(addprefix paper/,values.csv tables.csv measured.csv)
REPORT_SOURCES := $(addprefix paper/,report.tex macros.tex references.bib constants.txt) $(wildcard paper/sections/*.tex)

paper: $(REPORT)

$(PAPER)/generated/.:
	mkdir -p $@

$(VALUES): $(BIN)/report_values $(REPORT_LISTS) $(RESULTS) $(PRINTED) $(PUB)/stated_values.csv | $(PAPER)/generated/.
	$< --generated $(GEN) --published $(PUB) --quiet --output $@

$(REPORT): $(VALUES) $(REPORT_SOURCES) $(REPORT_LISTS) $(FIGURES:%=$(FIG)/%.pdf) tools/check_report tools/build_report
	tools/check_report paper
	tools/build_report $(PAPER)/generated $(FIG) $@

# ---------------------------------------------------------------- everything

all: results figures paper README.md $(GEN)/manifest.csv

# How each of them came about: commands, options, seeds, SHA-256 of inputs and outputs.
MANIFEST_VARIABLES = GEN=$(GEN) FIG=$(FIG) PAPER=$(PAPER) STUDIES=$(STUDIES)

$(GEN)/manifest.csv: $(RESULTS) $(STUDY) $(FIGURE_FILES) $(VALUES) $(REPORT) tools/manifest
	tools/manifest $@ $(MANIFEST_VARIABLES)

# The tables in the README are copies of generated ones, between markers that name the file.
README_TABLES := data/generated/compare_published.md data/generated/verdicts.md

README.md: $(README_TABLES) tools/splice
	tools/splice $@ $(README_TABLES)

test: $(BUILD)/.built
	cmake --build --preset release
	ctest --preset release -j $$(nproc)

check-manifest:
	tools/check_manifest $(GEN)/manifest.csv

# First the hashes of the manifest, then everything made again; each file that differs is named with the first difference.
# verify-parts takes the committed studies that take minutes each as they are, and makes parts of them again.
VERIFY := build/verify
STUDIES_OF_MINUTES := $(addprefix $(GEN)/,replicated_study.csv readings.csv cost_accuracy.csv benchmark_problems.csv)

verify: KEPT :=
verify-parts: KEPT := $(STUDIES_OF_MINUTES)
verify verify-parts: MAKE_AGAIN = $(MAKE) --no-print-directory GEN=$(VERIFY)/$(GEN) FIG=$(VERIFY)/$(FIG) PAPER=$(VERIFY)/$(PAPER) \
  $(KEPT:%=-o $(VERIFY)/%) results figures paper
verify verify-parts: build check-manifest
	rm -rf $(VERIFY)
	mkdir -p $(VERIFY)/$(GEN)
	$(if $(KEPT),cp $(KEPT) $(VERIFY)/$(GEN))
	$(MAKE_AGAIN)
	@$(MAKE_AGAIN) -q || { echo 'verify: a second make would make something again'; exit 1; }
	cp README.md $(VERIFY) && tools/splice $(VERIFY)/README.md $(README_TABLES)
	tools/compare_outputs $(GEN)/manifest.csv $(VERIFY)
	$(if $(KEPT),tools/verify_parts $(BIN) $(GEN) $(TABLE1))

SEED ?= 2

another-seed: build $(GEN)/compare_published.md $(GEN)/verdicts.md
	tools/another_seed $(BIN) $(GEN) $(PUB) $(SEED) $(STUDIES)

bench: $(BUILD)/.built
	cmake --preset release -DTMCMC_BUILD_BENCHMARKS=ON $(CMAKE_FLAGS) >$(BUILD).configure.log 2>&1
	cmake --build --preset release --target benchmarks
	@mkdir -p build/bench
	$(BIN)/benchmarks --benchmark_min_time=0.2 --benchmark_repetitions=5 --benchmark_report_aggregates_only=true \
	  --benchmark_out=build/bench/benchmarks.json --benchmark_out_format=json

# ---------------------------------------------------------------- for mpirun (docs/clusters.md)

build-mpi: | mpi-deps $(if $(filter deps,$(MAKECMDGOALS)),deps)
	@mkdir -p build
	cmake --preset mpi $(CMAKE_FLAGS) >build/mpi.configure.log 2>&1 || { cat build/mpi.configure.log; false; }
	cmake --build --preset mpi --target replicated_study

test-mpi: build-mpi
	cmake --build --preset mpi --target test_distributed shared_run
	ctest --preset mpi -R '^distributed'

bench-mpi: export OMPI_ALLOW_RUN_AS_ROOT := 1
bench-mpi: export OMPI_ALLOW_RUN_AS_ROOT_CONFIRM := 1
bench-mpi: build-mpi
	cmake --build --preset mpi --target shared_batch
	mpirun -np 1 build/mpi/bin/shared_batch
	mpirun -np 2 build/mpi/bin/shared_batch

# Times differ from machine to machine: no part of `make all`.
SCALING ?= build/scaling

scaling: $(BIN)/scaling
	@mkdir -p $(SCALING)
	$< --output $(SCALING)/scaling.csv
	figures/draw scaling $(SCALING) $(SCALING)

# Two compilers, debug builds with assertions, warnings as errors.
sanitize: | sanitize-deps
	for preset in asan-ubsan tsan; do \
	  cmake --preset $$preset >build/$$preset.configure.log 2>&1 || { cat build/$$preset.configure.log; exit 1; }; \
	  cmake --build --preset $$preset && ctest --preset $$preset -j $$(nproc) || exit 1; done

tidy: | sanitize-deps
	cmake -S . -B build/tidy -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DTMCMC_BUILD_TESTS=OFF \
	  -DTMCMC_BUILD_BENCHMARKS=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
	run-clang-tidy -quiet -p build/tidy '/(src|experiments|bench)/.*\.cpp$$' 2>&1 | tools/tidy_report

coverage: | coverage-deps
	cmake --preset coverage >/dev/null
	cmake --build --preset coverage
	find build/coverage -name '*.gcda' -delete
	ctest --preset coverage -j $$(nproc)
	gcovr --root . --object-directory build/coverage --filter src/ --exclude-throw-branches --txt build/coverage/lines.txt --print-summary

mutations: $(BUILD)/.built
	tests/mutations/run

FUZZ_SECONDS ?= 30
FUZZ_TARGETS := csv options

fuzz: | sanitize-deps
	@mkdir -p build/fuzz/corpus/csv build/fuzz/corpus/options
	cmake --preset asan-ubsan >build/asan-ubsan.configure.log 2>&1 || { cat build/asan-ubsan.configure.log; false; }
	cmake --build --preset asan-ubsan --target fuzz_targets
	@for t in $(FUZZ_TARGETS); do echo "fuzz: $$t, $(FUZZ_SECONDS) s"; \
	  build/asan-ubsan/bin/fuzz_$$t -max_total_time=$(FUZZ_SECONDS) -timeout=10 -rss_limit_mb=4096 -print_final_stats=1 -verbosity=0 \
	    -artifact_prefix=build/fuzz/$$t- build/fuzz/corpus/$$t tests/fuzz/corpus/$$t || exit 1; done

identical: | sanitize-deps $(if $(filter deps,$(MAKECMDGOALS)),deps)
	tools/identical_bytes

# ---------------------------------------------------------------- the libraries elsewhere

PREFIX ?= /usr/local

docs: doc-deps
	@mkdir -p build/docs
	doxygen docs/Doxyfile

install:
	cmake --preset release -B build/install -DTMCMC_BUILD_EXPERIMENTS=OFF -DTMCMC_BUILD_TESTS=OFF $(CMAKE_FLAGS)
	cmake --build build/install
	cmake --install build/install --prefix $(PREFIX)

clean:
	rm -rf build $(GEN)/sampling_study_samples.csv $(GEN)/sampling_study_stages.csv
