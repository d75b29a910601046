#!/usr/bin/python3
"""Holds the arrows of docs/architecture.md against the #include lines of a source tree.

usage: check_rooms.py ROOT

Prints each line that breaks a rule, and then exits 1:
- a room includes only itself and the rooms that it may use;
- what lies in a folder internal/ is included by its own layer only, and by no public header;
- a library is included only where the table below allows it;
- a source that has a header includes it first, so that the header is compiled alone.
"""

import pathlib
import re
import sys

LAYERS = ["lib", "cost_functions", "solvers", "distributed"]

# Room -> the rooms it may use. A room below never names one above.
MATHEMATICS = ["harmonics"]
SHAPES = ["mesh", "frames"] + MATHEMATICS
ROOMS = {
    "harmonics": [],
    "frames": MATHEMATICS,
    "mesh": [],
    "singularities": SHAPES,
    "alignment": SHAPES,
    "field": ["alignment", "singularities"] + SHAPES,
    "maps": ["field", "alignment", "singularities"] + SHAPES,
    "readers": ["mesh"],
    "io": ["readers", "maps", "field", "alignment", "singularities"] + SHAPES,
    "view": ["io", "maps", "field", "alignment", "singularities"] + SHAPES,
    "adaptors": ["io", "readers", "field", "alignment", "singularities"] + SHAPES,
    "grids": ["io", "readers", "field", "alignment", "singularities"] + SHAPES,
    "cost_functions": ["maps", "field", "alignment", "frames"] + MATHEMATICS,
    "minimization": [],
    "energies": ["minimization", "cost_functions", "field", "alignment", "frames"] + MATHEMATICS,
    "solvers": ["energies", "minimization", "cost_functions", "field", "alignment"] + SHAPES,
    "map_solvers": ["minimization", "maps"] + SHAPES,
    "distributed": ["solvers", "energies", "minimization", "io", "readers", "field", "alignment", "singularities"] + SHAPES,
}

# Library -> the rooms that may include it; all others are free to use Eigen and the standard library only.
LIBRARIES = {
    "ceres": ["cost_functions", "minimization", "energies", "solvers", "map_solvers", "distributed"],
    "gmsh": ["adaptors"],
    "mpi": ["distributed"],
    "OpenMesh": ["adaptors"],
    "openvdb": ["grids"],
    "petsc": ["distributed"],
    "pugixml": ["io", "readers"],
    "tbb": ["grids"],
    "zlib": ["io", "readers"],
}

INCLUDE = re.compile(r'\s*#\s*include\s*[<"]([^>"]+)[>"]')


def problem_of(room, layer, is_public, target, layer_of):
    """What is wrong with a file of `room` including `target`, or None."""
    parts = target.split("/")
    if parts[0] != "octupole":
        library = re.split(r"[./]", parts[0])[0]
        if library.startswith("petsc"):
            library = "petsc"  # petscdm.h, petsctao.h and so on
        if library in LIBRARIES and room not in LIBRARIES[library]:
            return f"only {', '.join(LIBRARIES[library])} may use {library}"
        return None
    if len(parts) < 3:
        return None  # octupole/version.h stands above no room and below all
    if parts[1] not in ROOMS:
        return f"there is no room {parts[1]}"
    if parts[1] != room and parts[1] not in ROOMS[room]:
        return f"room {room} may not use {parts[1]}"
    if parts[2] == "internal":
        if is_public:
            return "a public header may not include an internal one"
        if layer_of[parts[1]] != layer:
            return f"internal to the layer {layer_of[parts[1]]}"
    return None


def check(root):
    """The broken lines of the tree, each as file:line: what."""
    folders = [(layer, folder) for layer in LAYERS for folder in sorted((root / layer / "octupole").iterdir())
               if folder.is_dir()]
    layer_of = {folder.name: layer for layer, folder in folders}
    problems = [f"{name}: a room without a folder" for name in ROOMS if name not in layer_of]
    for layer, folder in folders:
        if folder.name not in ROOMS:
            problems.append(f"{folder}: a folder that is no room")
            continue
        for file in sorted(folder.rglob("*")):
            if file.suffix not in (".h", ".cc"):
                continue
            is_public = file.suffix == ".h" and file.parent == folder
            own = file.with_suffix(".h")
            is_first = file.suffix == ".cc" and own.exists()
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                problem = problem_of(folder.name, layer, is_public, match.group(1), layer_of)
                if is_first and match.group(1) != str(own.relative_to(root / layer)):
                    problem = problem or f"{own.name} has to be included first"
                is_first = False
                if problem:
                    problems.append(f"{file}:{number}: {problem}: {line.strip()}")
    return problems


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: check_rooms.py ROOT")
    problems = check(pathlib.Path(sys.argv[1]))
    for problem in problems:
        print(problem)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
