# Debian packages, a list for each purpose; each target installs what is missing of its list.
PACKAGES := g++ cmake ninja-build libeigen3-dev libboost-dev libceres-dev librandom123-dev libfmt-dev libcli11-dev \
  catch2 libbenchmark-dev libnetcdf-dev netcdf-bin libcereal-dev libcpp-httplib-dev nlohmann-json3-dev libtomlplusplus-dev pkgconf \
  python3 procps gnuplot-nox fonts-urw-base35 fontconfig poppler-utils \
  texlive-latex-recommended texlive-fonts-recommended

doc-deps: PACKAGES := doxygen
format-deps: PACKAGES := clang-format
reuse-deps: PACKAGES := reuse
ci-deps: PACKAGES := ccache
sanitize-deps: PACKAGES := clang lld clang-tidy libclang-rt-14-dev libomp-dev
coverage-deps: PACKAGES := gcovr
mpi-deps: PACKAGES := libopenmpi-dev openmpi-bin
python-deps: PACKAGES := g++ cmake ninja-build libeigen3-dev libboost-dev librandom123-dev pybind11-dev python3-dev python3-numpy \
  python3-scipy python3-xarray python3-h5netcdf python3-pytest python3-setuptools python3-pip python3-venv
reader-deps: PACKAGES := python3-xarray python3-h5netcdf
site-deps: PACKAGES := emscripten cmake ninja-build libeigen3-dev libboost-dev librandom123-dev libfmt-dev libcli11-dev libceres-dev \
  libfast-float-dev $(if $(shell command -v npm),,nodejs npm)
site-test-deps: PACKAGES := chromium

DEPS := deps doc-deps format-deps reuse-deps ci-deps sanitize-deps coverage-deps mpi-deps python-deps reader-deps site-deps site-test-deps
.PHONY: $(DEPS)
#: make deps        install the Debian packages that are missing (root or sudo only if there are any)
$(DEPS):
	@tools/install_packages $(PACKAGES)
