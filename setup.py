"""Builds the extension of the Python module by CMake; everything else is in pyproject.toml."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, ext: Extension) -> None:
        build = Path(self.build_temp).resolve()
        options = []
        try:  # of an environment of its own, such as pip makes; else CMake finds Debian's
            import pybind11

            options.append(f"-Dpybind11_DIR={pybind11.get_cmake_dir()}")
        except ImportError:
            pass
        subprocess.run(
            ["cmake", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
             "-DTMCMC_BUILD_PYTHON=ON", "-DTMCMC_BUILD_EXPERIMENTS=OFF", "-DTMCMC_BUILD_TESTS=OFF", f"-DPython_EXECUTABLE={sys.executable}", *options,
             *shlex.split(os.environ.get("CMAKE_ARGS", ""))],
            check=True,
        )
        jobs = str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", build, "--target", "python_core", "--parallel", jobs], check=True)
        target = Path(self.get_ext_fullpath(ext.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        built = next((build / "package" / "tmcmc").glob("_core*"))
        self.copy_file(str(built), str(target))


version = re.search(r"project\(tmcmc_companion VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
setup(
    version=version.group(1),
    ext_modules=[Extension("tmcmc._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)
