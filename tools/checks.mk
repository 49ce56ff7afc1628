# Checks of the code, of the committed files and of the machine's independence; docs/checks.md says what each has found.

.PHONY: test verify verify-parts check-manifest another-seed identical format-check reuse bench scaling sanitize tidy coverage mutations \
  fuzz build-mpi test-mpi bench-mpi python test-python bench-python docs install

#: make test        build and run the tests
test: | $(filter deps,$(MAKECMDGOALS))
	tools/build all
	ctest --preset release -j $$(nproc)

#: make check-manifest  the committed files and the sources against the manifest, in a second
check-manifest:
	@tools/step --check

# Of the studies that take minutes each, verify-parts takes the committed tables and makes parts of them again.
#: make verify      everything made again in build/verify and compared with the committed files
#: make verify-parts  the same in two minutes: of the four studies that take minutes each, parts
verify: build check-manifest
	tools/verify

verify-parts: build check-manifest
	tools/verify replicated_study readings cost_accuracy benchmark_problems
	tools/verify_parts $(BIN) $(GEN) $(TABLE1)

SEED ?= 2
#: make another-seed  replicated studies with SEED=2, and whether every verdict is the same
another-seed: build $(GEN)/compare_published.md $(GEN)/verdicts.md
	tools/another_seed $(BIN) $(GEN) $(PUB) $(SEED) $(STUDIES)

#: make identical   build with other compilers and instruction sets (VARIANTS, all) and compare the bytes of the samples
identical: | sanitize-deps $(filter deps,$(MAKECMDGOALS))
	tools/identical_bytes $(VARIANTS)

#: make format-check  whether clang-format would change a source, and whether a comment is too wide or stands behind its field
format-check: | format-deps
	@mkdir -p build
	find src experiments examples tests bench site -path site/node_modules -prune -o -name '*.[ch]pp' -print >build/.sources
	xargs clang-format --dry-run --Werror <build/.sources
	xargs awk '/\/\/\/</ || (length > 100 && /^ *\/\/\/? ? ? ?[^ \/]/) { print FILENAME ":" FNR ": expected a comment above its field, within 100 columns"; \
	  bad = 1 } END { exit bad }' <build/.sources

#: make reuse       whether each file has a copyright holder and a licence (REUSE)
reuse: | reuse-deps
	reuse lint

#: make sanitize    the test suite with the address and undefined-behaviour sanitizers; with the thread sanitizer where threads meet
sanitize: | sanitize-deps
	@mkdir -p build
	cmake --preset asan-ubsan >build/asan-ubsan.configure.log 2>&1 || { cat build/asan-ubsan.configure.log; false; }
	cmake --build --preset asan-ubsan
	ctest --preset asan-ubsan -j $$(nproc)
	cmake --preset tsan >build/tsan.configure.log 2>&1 || { cat build/tsan.configure.log; false; }
	cmake --build --preset tsan --target threads_tests
	ctest --preset tsan -j $$(nproc) -L threads

#: make fuzz        libFuzzer on the CSV reader and the command line, FUZZ_SECONDS each, with sanitizers
FUZZ_SECONDS ?= 30
fuzz: | sanitize-deps
	@mkdir -p build/fuzz/corpus/csv build/fuzz/corpus/options
	cmake --preset asan-ubsan >build/asan-ubsan.configure.log 2>&1 || { cat build/asan-ubsan.configure.log; false; }
	cmake --build --preset asan-ubsan --target fuzz_targets
	@for t in csv options; do echo "fuzz: $$t, $(FUZZ_SECONDS) s"; \
	  build/asan-ubsan/bin/fuzz_$$t -max_total_time=$(FUZZ_SECONDS) -timeout=10 -rss_limit_mb=4096 -print_final_stats=1 -verbosity=0 \
	    -artifact_prefix=build/fuzz/$$t- build/fuzz/corpus/$$t tests/fuzz/corpus/$$t || exit 1; done

#: make tidy        clang-tidy over src, experiments, examples and bench
tidy: | sanitize-deps
	cmake -S . -B build/tidy -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DTMCMC_BUILD_TESTS=OFF \
	  -DTMCMC_BUILD_BENCHMARKS=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
	run-clang-tidy -quiet -p build/tidy '/(src|experiments|examples|bench)/.*\.cpp$$' 2>&1 | tools/tidy_report

#: make coverage    lines of src/ that the tests run
coverage: | coverage-deps
	cmake --preset coverage >/dev/null
	cmake --build --preset coverage
	find build/coverage -name '*.gcda' -delete
	ctest --preset coverage -j $$(nproc)
	gcovr --root . --object-directory build/coverage --filter src/ --exclude-throw-branches --txt build/coverage/lines.txt --print-summary

#: make mutations   deliberate faults in src/, and which test sees each (half an hour)
mutations:
	tools/build all
	tests/mutations/run

#: make bench       measure speed (Google Benchmark)
bench:
	CMAKE_FLAGS="$(CMAKE_FLAGS) -DTMCMC_BUILD_BENCHMARKS=ON" tools/build benchmarks
	@mkdir -p build/bench
	$(BIN)/benchmarks --benchmark_min_time=0.2 --benchmark_repetitions=5 --benchmark_report_aggregates_only=true \
	  --benchmark_out=build/bench/benchmarks.json --benchmark_out_format=json

# Times differ from machine to machine: no part of `make all`.
#: make scaling     time and memory over samples, threads and observations, with figure, into SCALING=build/scaling
SCALING ?= build/scaling
scaling:
	tools/build scaling
	@mkdir -p $(SCALING)
	$(BIN)/scaling --output $(SCALING)/scaling.csv
	figures/draw scaling $(SCALING) $(SCALING)

# ---------------------------------------------------------------- for mpirun (docs/clusters.md)

#: make build-mpi   own_model for mpirun, into build/mpi/bin (OpenMPI is installed if missing)
build-mpi: | mpi-deps $(filter deps,$(MAKECMDGOALS))
	@mkdir -p build
	cmake --preset mpi $(CMAKE_FLAGS) >build/mpi.configure.log 2>&1 || { cat build/mpi.configure.log; false; }
	cmake --build --preset mpi --target own_model

#: make test-mpi    the same and its tests;  make bench-mpi  a batch of a slow model on one and two ranks
test-mpi: build-mpi
	cmake --build --preset mpi --target test_models shared_run
	ctest --preset mpi -R '^(models|ranks)$$'

bench-mpi: export OMPI_ALLOW_RUN_AS_ROOT := 1
bench-mpi: export OMPI_ALLOW_RUN_AS_ROOT_CONFIRM := 1
bench-mpi: build-mpi
	cmake --build --preset mpi --target shared_batch
	mpirun -np 1 build/mpi/bin/shared_batch
	mpirun -np 2 build/mpi/bin/shared_batch

# ---------------------------------------------------------------- the Python module (docs/python.md)

#: make python      the Python module, into build/python/package, for PYTHON=/usr/bin/python3 (pybind11 is installed if missing)
PYTHON ?= /usr/bin/python3
python: | python-deps
	@mkdir -p build
	cmake --preset python -DPython_EXECUTABLE=$(PYTHON) $(CMAKE_FLAGS) >build/python.configure.log 2>&1 || \
	  { cat build/python.configure.log; false; }
	cmake --build --preset python

#: make test-python  the same and its tests, and its installation by pip into a virtual environment
test-python: python
	ctest --preset python
	python/tests/install $(PYTHON)

#: make bench-python  how much of a run in Python is not spent in a batch log-likelihood in NumPy
bench-python: python
	PYTHONPATH=build/python/package $(PYTHON) bench/python_overhead.py

# ---------------------------------------------------------------- the libraries elsewhere

#: make docs        API reference by Doxygen, build/docs/html/index.html
docs: doc-deps
	@mkdir -p build/docs
	doxygen docs/Doxyfile

#: make install     the libraries, their headers and the CMake package into PREFIX=/usr/local
PREFIX ?= /usr/local
build-install:
	cmake --preset release -B build/install -DTMCMC_BUILD_EXPERIMENTS=OFF -DTMCMC_BUILD_TESTS=OFF -DTMCMC_BUILD_COMPONENTS=ON $(CMAKE_FLAGS)
	cmake --build build/install
install: build-install
	cmake --install build/install --prefix $(PREFIX)

#: make deb         the same as a package of Debian, build/install/libtmcmc-companion-dev_*.deb
deb: build-install
	cd build/install && cpack
.PHONY: build-install deb
