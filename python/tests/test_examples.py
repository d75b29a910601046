"""Each example runs and writes what it says."""

import pathlib
import subprocess
import sys

import pytest

EXAMPLES = sorted((pathlib.Path(__file__).resolve().parents[2] / "examples" / "python").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_example(example, bracket, tmp_path):
    usage = next(line for line in example.read_text().splitlines() if line.startswith("usage: "))
    outputs = [tmp_path / word for word in usage.split()[3:]]
    arguments = [bracket, *outputs] if "MESH" in usage else []
    done = subprocess.run([sys.executable, example, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("\n") >= 1
    for output in outputs:
        assert output.stat().st_size > 1000
