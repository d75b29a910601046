#!/usr/bin/python3
"""Reads a field with meshio, as ParaView's users do, and prints as JSON what is in it.

usage: read_field.py FIELD.vtu MESH
"""
import json
import sys

import meshio
import numpy as np

field, mesh = meshio.read(sys.argv[1]), meshio.read(sys.argv[2])
tets = np.concatenate([c.data for c in mesh.cells if c.type == "tetra"])
frames = np.stack([field.point_data["frame_" + k] for k in "xyz"], axis=2)
print(json.dumps({
    "same_points": bool(np.array_equal(field.points.astype(mesh.points.dtype), mesh.points)),
    "same_tets": bool(np.array_equal(field.cells_dict["tetra"], tets)),
    "orthonormality": float(np.abs(np.einsum("nki,nkj->nij", frames, frames) - np.eye(3)).max()),
    "right_handed": bool((np.linalg.det(frames) > 0).all()),
    "components": {k: int(np.prod(v.shape[1:])) for k, v in field.point_data.items()},
    "alignments": np.bincount(field.point_data["alignment"].ravel(), minlength=3).tolist(),
    "regions": sorted(set(np.concatenate(field.cell_data["region"]).tolist())) if "region" in field.cell_data else [],
}))
