"""A frame field on a mesh type of your own, with a term of your own and a frame that you prescribe: example 03 in Python.

The mesh is the wall of a pipe, a grid in cylinder coordinates. Fibres that wind around the pipe pull at the frames: each
vertex gets an edge to a vertex more, whose frame is that of the fibres there.

usage: 03_own_mesh.py
"""

from typing import Any

import numpy as np

import octupole

AROUND, ALONG, THROUGH = 24, 12, 3
PULL = 2.5


def main() -> None:
    k, j, i = np.indices((THROUGH, ALONG, AROUND)).reshape(3, -1)

    def vertex(i: "np.ndarray[Any, Any]", j: "np.ndarray[Any, Any]", k: "np.ndarray[Any, Any]") -> "np.ndarray[Any, Any]":
        return np.asarray((k * ALONG + j) * AROUND + i % AROUND)

    v = vertex(i, j, k)
    edges = np.concatenate([
        np.stack([v, vertex(i + 1, j, k)], axis=1),
        np.stack([v, vertex(i, j + 1, k)], axis=1)[j + 1 < ALONG],
        np.stack([v, vertex(i, j, k + 1)], axis=1)[k + 1 < THROUGH],
    ])
    angle = 2 * np.pi * i / AROUND
    outwards = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    around = np.cross([0, 0, 1], outwards)
    # The fibres climb at 30 degrees.
    along = np.cos(np.pi / 6) * around + np.sin(np.pi / 6) * np.array([0, 0, 1])
    fibres = np.stack([along, np.cross(outwards, along), outwards], axis=2)

    alignments = [axis if surface else None for axis, surface in zip(outwards, (k == 0) | (k + 1 == THROUGH))]
    alignments[0] = np.eye(3)  # a clamp: this one frame is given
    n = len(v)
    field = octupole.solve_graph(
        np.concatenate([edges, np.stack([v, v + n], axis=1)]),
        np.concatenate([np.ones(len(edges)), np.full(n, PULL)]),
        alignments + list(fibres),
    )
    off = octupole.frame_angle(field.frames[:n], fibres)
    print(f"{field.termination} after {field.iterations} iterations")
    print(f"at the far end the frames are within {off[j == ALONG - 1].max():.2f} degrees of the fibres; "
          f"at the clamp, {off[0]:.2f} off")
    assert off[j == ALONG - 1].max() < 1 and abs(off[0] - 30) < 1e-6


main()
