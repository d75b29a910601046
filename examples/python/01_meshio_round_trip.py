"""A mesh from meshio, whatever it reads, and the field back as point data of that mesh.

usage: 01_meshio_round_trip.py MESH OUTPUT.vtu
"""

import sys

import meshio
import numpy as np

import octupole


def main() -> None:
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    mesh = meshio.read(sys.argv[1])
    field = octupole.solve(mesh.points, mesh.get_cells_type("tetra"))
    for k, name in enumerate(["frame_x", "frame_y", "frame_z"]):
        mesh.point_data[name] = np.ascontiguousarray(field.frames[:, :, k])
    mesh.write(sys.argv[2])

    # Nothing was lost on the way.
    again = meshio.read(sys.argv[2])
    frames = np.stack([again.point_data[f"frame_{axis}"] for axis in "xyz"], axis=2)
    if not np.array_equal(frames, field.frames):
        sys.exit("the frames in the file are others")
    quality = field.quality()
    print(f"{len(mesh.points)} vertices, energy {quality.energy4:.1f}, {len(field.singular_curves().curves)} singular curves, "
          f"boundary error {quality.boundary_max_deg:.2g} degrees")


main()
