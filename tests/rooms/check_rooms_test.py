#!/usr/bin/python3
"""The arrows of this source tree hold, and each kind of line that breaks them is noticed."""

import pathlib
import shutil
import tempfile
import unittest

import check_rooms

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Rooms(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for layer in check_rooms.LAYERS:
            shutil.copytree(ROOT / layer, self.root / layer)

    def problems_with(self, file, line):
        path = self.root / file
        path.write_text(path.read_text() + line + "\n")
        return check_rooms.check(self.root)

    def test_the_tree_keeps_them(self):
        self.assertEqual(check_rooms.check(self.root), [])

    def test_no_room_is_above_itself(self):
        def below(room):
            return set(check_rooms.ROOMS[room]).union(*(below(other) for other in check_rooms.ROOMS[room]))

        for room in check_rooms.ROOMS:
            self.assertNotIn(room, below(room))

    def test_each_kind_of_broken_line_is_noticed(self):
        lines = [
            ("lib/octupole/mesh/tet_mesh.h", '#include "octupole/alignment/alignment.h"', "mesh may not use alignment"),
            ("lib/octupole/harmonics/rotation.cc", "#include <octupole/readers/tet_mesh_reader.h>", "harmonics may not use readers"),
            ("lib/octupole/readers/internal/vtk_cells.cc", ' #  include "octupole/minimization/lbfgs.h"', "readers may not use minimization"),
            ("lib/octupole/alignment/alignment.cc", "#include <ceres/ceres.h>", "may use ceres"),
            ("lib/octupole/readers/tet_mesh_reader.cc", "#include <gmsh.h>", "may use gmsh"),
            ("solvers/octupole/minimization/lbfgs.h", "#include <petsctao.h>", "may use petsc"),
            ("solvers/octupole/solvers/fast_solver.cc", '#include "octupole/distributed/mesh_part.h"', "solvers may not use"),
            ("lib/octupole/readers/tet_mesh_reader.h", '#include "octupole/readers/internal/vtk_cells.h"', "a public header"),
            ("solvers/octupole/solvers/mbo.cc", '#include "octupole/frames/internal/symmetric_eigen.h"', "internal to"),
            ("lib/octupole/mesh/tet_mesh.cc", '#include "octupole/tet_mesh/x.h"', "there is no room tet_mesh"),
        ]
        before = 0
        for file, line, message in lines:
            with self.subTest(line=line):
                problems = self.problems_with(file, line)
                self.assertEqual(len(problems), before + 1)
                self.assertTrue(any(message in problem for problem in problems), problems)
            before += 1

    def test_a_header_that_is_not_included_first_is_noticed(self):
        path = self.root / "lib/octupole/mesh/tet_mesh.cc"
        path.write_text("#include <vector>\n" + path.read_text())
        self.assertEqual(len(check_rooms.check(self.root)), 1)
        self.assertIn("tet_mesh.h has to be included first", check_rooms.check(self.root)[0])

    def test_a_folder_that_is_no_room_is_noticed(self):
        (self.root / "lib/octupole/misc").mkdir()
        self.assertIn("no room", check_rooms.check(self.root)[0])


if __name__ == "__main__":
    unittest.main()
