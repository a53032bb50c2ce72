"""Builds the extension by CMake; pyproject.toml has the rest.

MASSPROPS_BUILD_DIR names a build folder of CMake that is there already; CMAKE_ARGS are further arguments.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        target = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        build = pathlib.Path(os.environ.get("MASSPROPS_BUILD_DIR") or pathlib.Path(self.build_temp)).resolve()
        if not (build / "CMakeCache.txt").exists():
            subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DCMAKE_CXX_FLAGS_RELEASE=-O3 -DNDEBUG", "-DMASSPROPS_BUILD_PYTHON=ON",
                            "-DMASSPROPS_BUILD_PLUGIN=OFF", "-DMASSPROPS_BUILD_COMMAND_LINE=OFF",
                            "-DMASSPROPS_BUILD_TESTS=OFF", "-DMASSPROPS_BUILD_SAMPLES=OFF",
                            "-DMASSPROPS_BUILD_BENCHMARKS=OFF", f"-DPython_EXECUTABLE={sys.executable}",
                            *shlex.split(os.environ.get("CMAKE_ARGS", ""))], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "_massprops"], check=True)
        target.mkdir(parents=True, exist_ok=True)
        for file in (build / "python" / "massprops").iterdir():
            if file.is_file():
                shutil.copy(file, target)


version = re.search(r"project\(massprops VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
setup(version=version, ext_modules=[Extension("massprops._massprops", [])],
      cmdclass={"build_ext": CMakeBuild})
