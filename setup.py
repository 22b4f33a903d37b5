"""Has CMake build the extension modules; all else stands in pyproject.toml."""

import os
import pathlib
import re
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = pathlib.Path(__file__).resolve().parent
version = re.search(r"project\(Fathom VERSION (\S+)", (root / "CMakeLists.txt").read_text())[1]


class BuildByCMake(build_ext):
    """In a folder for each Python, so that several may be built beside each other, and again in little time."""

    def build_extension(self, extension):
        target = pathlib.Path(self.get_ext_fullpath(extension.name)).resolve()
        # What a build of CMake's has made already is taken where this names its folder `python`.
        folder = os.environ.get("FATHOM_BUILT_MODULE") or self.build_module()
        built = pathlib.Path(folder) / "fathom" / target.name
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(built), str(target))

    def build_module(self):
        name = "pip-" + (sysconfig.get_config_var("SOABI") or "python")
        self.carry_out([root / "scripts/build", name, "fathom_python", "--", "-DCMAKE_BUILD_TYPE=Release",
                        "-DFATHOM_PYTHON=ON", "-DPython3_EXECUTABLE=" + self.python()])
        return root / "build" / name / "python"

    @staticmethod
    def carry_out(command):
        try:
            subprocess.run(command, check=True)
        except subprocess.CalledProcessError:
            raise SystemExit("fathom: the module could not be built; `scripts/install-dependencies core python` installs "
                             "what it is built from") from None

    @staticmethod
    def python():
        """The interpreter that the environments of pip borrow: what CMake remembers outlives them."""
        return getattr(sys, "_base_executable", None) or sys.executable


setup(version=version,
      ext_modules=[Extension(name, []) for name in ("fathom._core", "fathom._doctor", "fathom._studies", "fathom._textbook")],
      cmdclass={"build_ext": BuildByCMake})
