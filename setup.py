"""pip install: builds the Python package by CMake, with everything of the library that it needs inside."""

import pathlib
import re
import sys

from skbuild import setup

ROOT = pathlib.Path(__file__).parent
PROJECT = re.search(r'project\(octupole VERSION (\S+).*?DESCRIPTION "([^"]+)"', (ROOT / "CMakeLists.txt").read_text(), re.S)

setup(
    name="octupole",
    version=PROJECT.group(1),
    description=PROJECT.group(2),
    long_description=(ROOT / "python" / "README.md").read_text(),
    long_description_content_type="text/markdown",
    license="MIT",
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["octupole"],
    package_dir={"": "python"},
    package_data={"octupole": ["py.typed", "_core.pyi"]},
    cmake_args=[
        "-DOCTUPOLE_WITH_PYTHON=ON",
        "-DOCTUPOLE_BUILD_TOOLS=OFF",
        "-DOCTUPOLE_PYTHON_INSTALL_DIR=python",
        f"-DPython3_EXECUTABLE={sys.executable}",
    ],
    cmake_install_target="install_python",
    zip_safe=False,
)
