"""The package under test is found by PYTHONPATH, the command octupole by OCTUPOLE_COMMAND."""

import os
import pathlib
import shutil

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def bracket():
    """A mesh file with sharp edges and singular curves."""
    return ROOT / "examples" / "data" / "bracket.mesh"


@pytest.fixture(scope="session")
def command():
    found = os.environ.get("OCTUPOLE_COMMAND") or shutil.which("octupole")
    assert found, "set OCTUPOLE_COMMAND to the command octupole that was built beside the package"
    return found
