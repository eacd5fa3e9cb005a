"""pip install --no-build-isolation ./python: CMake builds the C++ part of the module."""
import pathlib
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent.parent


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        build = pathlib.Path(self.build_temp).resolve()
        build.mkdir(parents=True, exist_ok=True)
        subprocess.run(["cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DTALUS_BUILD_TESTS=OFF", "-DTALUS_BUILD_BENCH=OFF", "-DTALUS_WARNINGS_AS_ERRORS=OFF",
                        # The module is of one version of Python: that which pip runs in.
                        f"-DPython3_EXECUTABLE={sys.executable}", f"-DPYTHON_EXECUTABLE={sys.executable}"], check=True)
        subprocess.run(["cmake", "--build", build, "--target", "talus_python"], check=True)
        built = next((build / "python/talus").glob("_core*.so"))
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(built, target)


setup(packages=["talus"], package_data={"talus": ["*.pyi", "py.typed"]},
      ext_modules=[Extension("talus._core", [])], cmdclass={"build_ext": CMakeBuild})
