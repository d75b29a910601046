"""How methods and seeds do on a mesh: energy of the frames against time, as a picture.

usage: 02_compare_methods.py MESH PICTURE.png
"""

import sys
import time
from typing import Any, Dict

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import octupole

METHODS: Dict[str, Dict[str, Any]] = {
    "octupoles": {"degree": 3},
    "degree 4": {"degree": 4},
    "ray-sokolov": {"degree": 4, "method": "ray-sokolov"},
    "mbo": {"degree": 4, "method": "mbo"},
}
SEEDS = range(3)


def main() -> None:
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    mesh = octupole.read(sys.argv[1])
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    for (name, options), marker in zip(METHODS.items(), "os^D"):
        seconds, energies = [], []
        for seed in SEEDS:
            start = time.perf_counter()
            field = octupole.solve(mesh, seed=seed, **options)
            seconds.append(time.perf_counter() - start)
            energies.append(field.quality().energy4)
        axes.plot(seconds, energies, marker, label=name, markersize=8, alpha=0.7)
        print(f"{name:12} energy {min(energies):9.2f} .. {max(energies):9.2f}, {sum(seconds) / len(seconds):.2f} s")
    axes.set_xlabel("seconds")
    axes.set_ylabel("energy of the frames (degree 4)")
    axes.set_title(f"{len(mesh.points)} vertices, {len(SEEDS)} seeds each")
    axes.set_xlim(left=0)
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(sys.argv[2], dpi=120)


main()
