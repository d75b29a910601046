import gc
import json
import subprocess

import numpy as np
import pytest

import octupole

BOX = octupole.box_mesh((2, 2, 2))
POINTS, TETS = BOX.points.copy(), BOX.tets.copy()


def strided(array):
    wide = np.zeros((2 * array.shape[0], 2 * array.shape[1]), dtype=array.dtype)
    wide[::2, ::2] = array
    return wide[::2, ::2]


def locked(array):
    array = array.copy()
    array.flags.writeable = False
    return array


@pytest.mark.parametrize("change", [np.asfortranarray, strided, locked, lambda a: a[::-1][::-1], np.ndarray.tolist])
def test_any_layout_gives_the_same_mesh(change):
    mesh = octupole.TetMesh(change(POINTS), change(TETS))
    np.testing.assert_array_equal(mesh.points, POINTS)
    np.testing.assert_array_equal(mesh.tets, TETS)


@pytest.mark.parametrize("kind", [np.int8, np.uint8, np.int16, np.int32, np.uint32, np.int64, np.uint64, ">i4"])
def test_any_integers_are_indices(kind):
    np.testing.assert_array_equal(octupole.TetMesh(POINTS, TETS.astype(kind)).tets, TETS)


def test_coordinates_of_other_precision():
    np.testing.assert_array_equal(octupole.TetMesh(POINTS.astype(np.float32), TETS).points, POINTS)
    np.testing.assert_array_equal(octupole.TetMesh((2 * POINTS).astype(int), TETS).points, 2 * POINTS)


def changed(array, value, dtype=None):
    array = array.astype(dtype or array.dtype)
    array[3, 1] = value
    return array


@pytest.mark.parametrize("points, tets, message", [
    (POINTS[:, :2], TETS, r"points: the shape is \(27, 2\), not \(n, 3\)"),
    (POINTS.ravel(), TETS, r"points: the shape is \(81,\), not \(n, 3\)"),
    (POINTS, TETS[:, :3], r"tets: the shape is \(48, 3\), not \(n, 4\)"),
    (POINTS, [], "tets: there are none"),
    (changed(POINTS, np.nan), TETS, "point 3"),
    (changed(POINTS, np.inf), TETS, "point 3"),
    (POINTS, changed(TETS, 27), "tetrahedron 3 .*27"),
    (POINTS, changed(TETS, -1), "tetrahedron 3 .*-1"),
    (POINTS, changed(TETS, 2**40, np.int64), "tetrahedron 3 .*1099511627776"),
    (POINTS, changed(TETS, 2**64 - 1, np.uint64), "tetrahedron 3 .*18446744073709551615"),
    (POINTS, changed(TETS, TETS[3, 0]), "tetrahedron 3"),
])
def test_wrong_values_are_value_errors(points, tets, message):
    with pytest.raises(ValueError, match=message):
        octupole.TetMesh(points, tets)
    with pytest.raises(ValueError, match=message):
        octupole.solve(points, tets)


@pytest.mark.parametrize("points, tets, message", [
    (POINTS, TETS.astype(float), "tets: integers expected, not float64"),
    (POINTS, TETS.astype(bool), "tets: integers expected, not bool"),
    (POINTS, None, "tets: integers expected, not object"),
    (POINTS.astype(complex), TETS, "points: real numbers expected, not complex128"),
    (POINTS.astype(str), TETS, "points: real numbers expected"),
    (POINTS.astype("M8[s]"), TETS, "points: real numbers expected"),
    (None, TETS, "points: real numbers expected, not object"),
    (BOX, TETS, "solve: a TetMesh comes without tets"),
])
def test_arrays_of_another_kind_are_type_errors(points, tets, message):
    with pytest.raises(TypeError, match=message):
        octupole.solve(points, tets)


def test_features_and_regions():
    mesh = octupole.TetMesh(POINTS, TETS, regions=np.arange(48), feature_edges=[[0, 1]], feature_points=[0])
    np.testing.assert_array_equal(mesh.regions, np.arange(48))
    np.testing.assert_array_equal(mesh.feature_edges, [[0, 1]])
    np.testing.assert_array_equal(mesh.feature_points, [0])
    assert BOX.regions.shape == (0,) and BOX.feature_edges.shape == (0, 2)
    for wrong in ({"regions": [1, 2]}, {"feature_edges": [[0, 99]]}, {"feature_edges": [[0, 1, 2]]},
                  {"regions": [2**31] * 48}):
        with pytest.raises(ValueError):
            octupole.TetMesh(POINTS, TETS, **wrong)
    with pytest.raises(TypeError):
        octupole.TetMesh(POINTS, TETS, regions=np.ones(48))


def test_arrays_are_views_that_outlive_the_mesh():
    mesh = octupole.box_mesh((3, 3, 3), (1, 2, 3))
    points = mesh.points
    assert np.shares_memory(points, mesh.points) and not points.flags.owndata and not points.flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        points[0] = 1
    expected = points.copy()
    del mesh
    gc.collect()
    np.testing.assert_array_equal(points, expected)
    np.testing.assert_array_equal(expected.max(axis=0), [1, 2, 3])


def test_the_mesh_has_its_own_memory():
    points = POINTS.copy()
    mesh = octupole.TetMesh(points, TETS)
    points[:] = 0
    np.testing.assert_array_equal(mesh.points, POINTS)


def test_reading(bracket, tmp_path):
    mesh = octupole.read(bracket)
    assert mesh.points.dtype == np.float64 and mesh.tets.dtype == np.int32
    np.testing.assert_array_equal(octupole.read(str(bracket)).tets, mesh.tets)
    with pytest.raises(OSError, match="nowhere.mesh"):
        octupole.read(tmp_path / "nowhere.mesh")
    broken = tmp_path / "broken.mesh"
    broken.write_text("MeshVersionFormatted 2\nDimension 3\nVertices\n1\n0 0 x 0\n")
    with pytest.raises(OSError, match=r"broken\.mesh:5: "):
        octupole.read(broken)


def test_what_a_reader_leaves_out_is_a_warning(tmp_path):
    with_triangle = tmp_path / "tet.vtk"
    with_triangle.write_text("# vtk DataFile Version 3.0\ntet\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n"
                             "0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\nCELLS 2 11\n4 0 1 2 3\n5 0 1 2 3 4\n"
                             "CELL_TYPES 2\n10\n14\n")
    with pytest.warns(UserWarning, match="tet.vtk: "):
        octupole.read(with_triangle)


def test_box_mesh_checks():
    with pytest.raises(ValueError, match="MakeBoxMesh"):
        octupole.box_mesh((0, 1, 1))


def test_info_is_that_of_the_command(bracket, command, tmp_path):
    report = tmp_path / "info.json"
    subprocess.run([command, "info", bracket, "--report", report, "--quiet"], check=True)
    expected = json.loads(report.read_text())
    assert expected.pop("mesh") == str(bracket)
    assert octupole.info(octupole.read(bracket)) == expected


def test_info_says_what_is_odd():
    mesh = octupole.TetMesh(
        [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [9, 9, 9]], [[0, 2, 1, 3]], regions=[7]
    )
    info = octupole.info(mesh)
    assert info["regions"] == [{"tag": 7, "tets": 1}]
    assert info["boundary_components"] == [{"triangles": 4, "euler_characteristic": 2, "genus": 0}]
    assert info["inverted_tets"] == 1
    assert [warning for warning in info["warnings"] if "belongs to no tetrahedron" in warning]
