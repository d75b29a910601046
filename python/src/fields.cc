#include "fields.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "octupole/alignment/constraints.h"
#include "octupole/field/cross_field.h"
#include "octupole/field/field_quality.h"
#include "octupole/field/field_sampler.h"
#include "octupole/field/tet_frames.h"
#include "octupole/io/cross_field_writer.h"
#include "octupole/io/field_writer.h"
#include "octupole/io/singularity_writer.h"
#include "octupole/mesh/mesh_topology.h"
#include "octupole/singularities/singular_curves.h"
#include "octupole/singularities/surface_singularities.h"
#include "octupole/solvers/field_solver.h"
#include "octupole/solvers/method_names.h"
#include "octupole/solvers/solver_presets.h"
#include "surface_mesh.h"

namespace octupole::python {
namespace {

struct TetField : AnyField {
  std::shared_ptr<const TetMesh> mesh;
  /// Made when it is first asked for.
  std::shared_ptr<const FieldSampler> sampler;
};

struct SurfaceField : AnyField {
  std::shared_ptr<const SurfaceMesh> mesh;
};

// An axis (3,) or a frame (3, 3), at an index for messages.
Alignment AlignmentFrom(const Reals& value, const std::string& name, py::ssize_t index) {
  try {
    if (value.ndim() == 1 && value.shape(0) == 3) {
      return Alignment::Axis(Eigen::Map<const Eigen::Vector3d>(value.data()));
    }
    if (value.ndim() == 2 && value.shape(0) == 3 && value.shape(1) == 3) {
      return Alignment::Frame(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(value.data()));
    }
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(name + ": element " + std::to_string(index) + ": " + error.what());
  }
  throw std::invalid_argument(name + ": the shape of element " + std::to_string(index) + " is " + ShapeOf(value) +
                              ", not (3,) or (3, 3)");
}

// Pairs of vertices (k,) and axes (k, 3) or frames (k, 3, 3).
std::vector<Constraint> ConstraintsFrom(const py::object& object) {
  std::vector<Constraint> constraints;
  if (object.is_none()) return constraints;
  for (const py::handle pair : object) {
    if (py::len(pair) != 2) throw std::invalid_argument("constraints: pairs of vertices and directions expected");
    const auto parts = py::reinterpret_borrow<py::object>(pair);
    const std::vector<int> vertices = ValuesFrom(parts[py::int_(0)], "constraints");
    const Reals directions = RealsFrom(parts[py::int_(1)], "constraints");
    if (directions.ndim() == 0 || static_cast<std::size_t>(directions.shape(0)) != vertices.size()) {
      throw std::invalid_argument("constraints: directions of shape " + ShapeOf(directions) + " for " +
                                  std::to_string(vertices.size()) + " vertices");
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const auto index = static_cast<py::ssize_t>(i);
      constraints.push_back(
          {vertices[i], AlignmentFrom(RealsFrom(directions[py::int_(i)], "constraints"), "constraints", index)});
    }
  }
  return constraints;
}

// The start of a solve on these points: the frames of a field, on whichever mesh, or the caller's array.
template <int kDegree>
void SetStart(const py::object& start, const std::vector<Eigen::Vector3d>* points, FieldOptions<kDegree>* options) {
  if (start.is_none()) return;
  if (points != nullptr && py::isinstance<TetField>(start)) {
    const auto& field = start.cast<const TetField&>();
    options->start_frames = Unlocked([&] { return TransferFrames(*field.mesh, field.solution().frames, *points); });
    return;
  }
  const Reals array = RealsFrom(py::isinstance<AnyField>(start) ? start.attr("frames") : start, "start");
  if (array.ndim() == 3) {
    options->start_frames = FramesFrom(array, "start");
    return;
  }
  CheckShape(array, "start", {kDimension<kDegree>}, /*is_list=*/true);
  options->start.resize(array.shape(0));
  for (std::size_t v = 0; v < options->start.size(); ++v) {
    options->start[v] = Eigen::Map<const Harmonic<kDegree>>(array.data() + v * kDimension<kDegree>);
  }
}

const std::vector<Eigen::Vector3d>* PointsOf(const TetMesh& mesh) { return &mesh.points; }
const std::vector<Eigen::Vector3d>* PointsOf(const TriangleMesh& mesh) { return &mesh.points; }
const std::vector<Eigen::Vector3d>* PointsOf(const FieldGraph& /*graph*/) { return nullptr; }

template <int kDegree, typename Mesh>
Field<kDegree> SolveUnlocked(const Mesh& mesh, const SolveArguments& arguments, Progress* progress) {
  FieldOptions<kDegree> options = OptionsFrom<kDegree>(arguments, progress);
  SetStart<kDegree>(arguments.start, PointsOf(mesh), &options);
  Field<kDegree> field = Unlocked([&] { return SolveField<kDegree>(mesh, options); });
  progress->ThrowError();
  CheckUsable(field);
  return field;
}

template <typename Mesh>
AnyField Solve(const Mesh& mesh, const SolveArguments& arguments, const py::object& callback) {
  Progress progress(callback);
  return OfDegree(arguments.degree, [&](auto degree) {
    return AnyField{SolveUnlocked<decltype(degree)::value>(mesh, arguments, &progress)};
  });
}

// Edges (m, 2), weights (m,) or one for all, and for each vertex None, an axis or a frame.
FieldGraph GraphFrom(const py::object& edges, const py::object& weights, const py::object& alignments) {
  FieldGraph graph;
  py::ssize_t v = 0;
  for (const py::handle alignment : alignments) {
    graph.alignments.push_back(
        alignment.is_none() ? Alignment() : AlignmentFrom(RealsFrom(alignment, "alignments"), "alignments", v));
    ++v;
  }
  const auto ends = RowsFrom<2>(edges, "edges");
  const Reals values = RealsFrom(weights, "weights");
  if (values.ndim() != 0 && (values.ndim() != 1 || static_cast<std::size_t>(values.size()) != ends.size())) {
    throw std::invalid_argument("weights: the shape is " + ShapeOf(values) + " for " + std::to_string(ends.size()) +
                                " edges");
  }
  for (std::size_t e = 0; e < ends.size(); ++e) {
    graph.edges.push_back({ends[e][0], ends[e][1], values.data()[values.ndim() == 0 ? 0 : e]});
  }
  return graph;
}

// The degree of a field.
template <int kDegree>
constexpr int DegreeOf(const Field<kDegree>& /*field*/) {
  return kDegree;
}

// A property of any field.
template <typename Function>
auto Property(const Function& function) {
  return
      [function](const AnyField& field) { return std::visit([&](const auto& f) { return function(f); }, field.field); };
}

py::array CoefficientsOf(const py::object& self) {
  return std::visit([&](const auto& f) { return ViewOf(f.coefficients, self); }, self.cast<const AnyField&>().field);
}

py::array AlignmentOf(const AnyField& field) {
  std::vector<int> kinds;
  for (const Alignment& alignment : field.alignments()) kinds.push_back(static_cast<int>(alignment.kind()));
  return ArrayOf(std::move(kinds));
}

SingularCurves CurvesOf(const TetField& field) {
  const auto& frames = field.solution().frames;
  return TraceSingularCurves(*field.mesh, frames, FindSingularTriangles(*field.mesh, frames));
}

template <int kDegree>
void WriteFieldOf(const std::filesystem::path& path, const TetMesh& mesh, const Field<kDegree>& field) {
  WriteField<kDegree>(path, mesh, field.coefficients, field.frames, field.alignment.alignments);
}

py::tuple Sample(TetField& field, const py::object& points) {
  const std::vector<Eigen::Vector3d> where = PointsFrom(points, "points");
  if (!field.sampler) {
    field.sampler =
        Unlocked([&] { return std::make_shared<const FieldSampler>(*field.mesh, field.solution().frames); });
  }
  const std::shared_ptr<const FieldSampler> sampler = field.sampler;
  FieldSamples samples = Unlocked([&] { return sampler->Sample(where); });
  return py::make_tuple(ArrayOf(std::move(samples.frames)), ArrayOf(std::move(samples.is_inside)));
}

void Write(const TetField& field, const std::filesystem::path& path) {
  WithFile([&] { std::visit([&](const auto& f) { WriteFieldOf(path, *field.mesh, f); }, field.field); });
}

void WriteCurves(const TetField& field, const std::filesystem::path& path) {
  WithFile([&] {
    const auto boundary = BoundaryTriangles(*field.mesh);
    WriteSingularities(path, CurvesOf(field), field.mesh->points, boundary,
                       QuarterIndices(field.mesh->points, boundary, field.solution().frames));
  });
}

std::vector<int> IndicesOf(const SurfaceField& field) {
  return QuarterIndices(field.mesh->points, field.mesh->triangles, field.solution().frames);
}

void WriteCrosses(const SurfaceField& field, const std::filesystem::path& path) {
  WithFile([&] {
    const SurfaceMesh& mesh = *field.mesh;
    WriteCrossField(path, mesh, mesh.faces, CrossField(mesh, field.solution().frames), field.alignments(),
                    QuarterIndicesOfFaces(mesh.faces, IndicesOf(field)));
  });
}

const char* NameOf(CurveEnd end) {
  constexpr std::array<const char*, 4> kNames = {"none", "boundary", "node", "open"};
  return kNames[static_cast<std::size_t>(end)];
}

std::map<std::string, std::size_t> CountsByType(const FieldQuality& quality) {
  std::map<std::string, std::size_t> counts;
  for (std::size_t type = 1; type < kTurnTypeNames.size(); ++type) {
    counts[kTurnTypeNames[type]] = quality.singular_triangles_of_type[type];
  }
  return counts;
}

void AddQuality(py::module_* module) {
  py::class_<FieldQuality>(*module, "FieldQuality",
                           R"(What can be said of frames on a tet mesh, whoever computed them.)")
      .def_readonly("edges", &FieldQuality::edges, "of the mesh")
      .def_readonly("energy3", &FieldQuality::energy3, "sum over the edges of frame_difference in degree 3")
      .def_readonly("energy4", &FieldQuality::energy4, "the same in degree 4; compare methods by it")
      .def_readonly("boundary_rms_deg", &FieldQuality::boundary_rms_deg,
                    "degrees between normal and nearest axis over the smooth boundary vertices, root mean square")
      .def_readonly("boundary_max_deg", &FieldQuality::boundary_max_deg, "the largest of them")
      .def_readonly("smooth_boundary_vertices", &FieldQuality::smooth_boundary_vertices, "how many there are")
      .def_readonly("singular_triangles", &FieldQuality::singular_triangles, "triangles that a singular curve crosses")
      .def_property_readonly("singular_triangles_by_type", &CountsByType, "the same by the type of their turn")
      .def("__repr__", [](const FieldQuality& quality) {
        return "<octupole.FieldQuality: energy4 " + static_cast<std::string>(py::str(py::float_(quality.energy4))) +
               ", " + std::to_string(quality.singular_triangles) + " singular triangles>";
      });
  module->def(
      "measure",
      [](const std::shared_ptr<TetMesh>& mesh, const py::object& frames) {
        const std::vector<Eigen::Matrix3d> rotations = FramesFrom(frames, "frames");
        return Unlocked([&] { return MeasureField(*mesh, rotations); });
      },
      py::arg("mesh"), py::arg("frames"), R"(measure(mesh, frames)
--

The FieldQuality of any frames, (n, 3, 3) with the axes as columns, on a TetMesh.)");
}

void AddCurves(py::module_* module) {
  py::class_<SingularCurve>(*module, "SingularCurve", "A curve of singular triangles.")
      .def_property_readonly(
          "type", [](const SingularCurve& curve) { return kTurnTypeNames[static_cast<std::size_t>(curve.type)]; },
          "of the turn around it: 'quarter', 'half', 'diagonal_half' or 'third'")
      .def_readonly("valence", &SingularCurve::valence, "3 or 5, or 0 where it has none")
      .def_property_readonly(
          "points", [](const py::object& self) { return ViewOf(self.cast<const SingularCurve&>().points, self); },
          "(k, 3) float64, read-only; a loop ends with its first point")
      .def_readonly("length", &SingularCurve::length, "in the mesh's unit")
      .def_readonly("mean_cosine", &SingularCurve::mean_cosine, "of the turn's axis with the curve")
      .def_property_readonly(
          "ends",
          [](const SingularCurve& curve) { return py::make_tuple(NameOf(curve.ends[0]), NameOf(curve.ends[1])); },
          "two of 'boundary', 'node' and 'open', or 'none' twice for a loop")
      .def_property_readonly("is_loop", &SingularCurve::is_loop)
      .def("__repr__", [](const SingularCurve& curve) {
        return "<octupole.SingularCurve: " + std::string(kTurnTypeNames[static_cast<std::size_t>(curve.type)]) +
               ", valence " + std::to_string(curve.valence) + ", " + std::to_string(curve.points.size()) + " points>";
      });
  py::class_<SingularCurves>(*module, "SingularCurves",
                             "The singular structure of a field: curves, and where they meet.")
      .def_property_readonly(
          "curves",
          [](const py::object& self) {
            py::list curves;
            for (const SingularCurve& curve : self.cast<const SingularCurves&>().curves) {
              curves.append(py::cast(curve, py::return_value_policy::reference_internal, self));
            }
            return curves;
          },
          "list of SingularCurve")
      .def_property_readonly(
          "nodes",
          [](const SingularCurves& curves) {
            std::vector<Eigen::Vector3d> points;
            for (const SingularNode& node : curves.nodes) points.push_back(node.point);
            return ArrayOf(std::move(points));
          },
          "(k, 3) float64: where curves meet")
      .def_property_readonly(
          "node_ends",
          [](const SingularCurves& curves) {
            std::vector<int> ends;
            for (const SingularNode& node : curves.nodes) ends.push_back(node.num_ends);
            return ArrayOf(std::move(ends));
          },
          "(k,) int32: how many curve ends meet in each node")
      .def("__repr__", [](const SingularCurves& curves) {
        return "<octupole.SingularCurves: " + std::to_string(curves.curves.size()) + " curves, " +
               std::to_string(curves.nodes.size()) + " nodes>";
      });
}

void AddFieldClasses(py::module_* module) {
  py::class_<AnyField>(*module, "GraphField", R"(One frame per vertex, and how they were found.

Arrays are read-only views of the field's memory.)")
      .def_property_readonly(
          "frames", [](const py::object& self) { return ViewOf(self.cast<const AnyField&>().solution().frames, self); },
          "(n, 3, 3) float64: frames[v] is a rotation whose columns are the axes at vertex v")
      .def_property_readonly("coefficients", &CoefficientsOf,
                             "(n, 7) float64 octupoles, or in degree 4 (n, 9), as they were minimised: not normalised")
      .def_property_readonly("alignment", &AlignmentOf,
                             "(n,) int32: 0 free, 1 an axis is prescribed, 2 the frame is prescribed")
      .def_property_readonly("degree", Property([](const auto& f) { return DegreeOf(f); }),
                             "of the coefficients, 3 or 4")
      .def_property_readonly("energy", Property([](const FrameSolution& s) { return s.energy; }),
                             "what the method minimised; to compare methods, see measure()")
      .def_property_readonly("iterations", Property([](const FrameSolution& s) {
                               return s.iterations.empty() ? 0 : s.iterations.back().iteration;
                             }),
                             "of all minimisations together")
      .def_property_readonly(
          "termination", Property([](const FrameSolution& s) { return ceres::TerminationTypeToString(s.termination); }),
          "'CONVERGENCE', 'NO_CONVERGENCE' where max_iterations were spent, 'USER_SUCCESS' where the callback ended it")
      .def_property_readonly("unknowns", Property([](const FrameSolution& s) { return s.size.unknowns; }),
                             "of the finest problem")
      .def_property_readonly("seconds", Property([](const auto& f) {
                               return std::map<std::string, double>{{"setup", f.setup_seconds},
                                                                    {"solve", f.solve_seconds},
                                                                    {"project", f.project_seconds}};
                             }),
                             "wall-clock seconds: {'setup', 'solve', 'project'}")
      .def("__repr__", [](const py::object& self) {
        const auto& solution = self.cast<const AnyField&>().solution();
        return "<octupole." + self.get_type().attr("__name__").cast<std::string>() + ": " +
               std::to_string(solution.frames.size()) + " frames, energy " +
               static_cast<std::string>(py::str(py::float_(solution.energy))) + ", " +
               ceres::TerminationTypeToString(solution.termination) + ">";
      });
  py::class_<TetField, AnyField>(*module, "Field", "A frame field on a TetMesh.")
      .def_property_readonly("mesh", [](const TetField& field) { return std::const_pointer_cast<TetMesh>(field.mesh); })
      .def(
          "quality",
          [](const TetField& field) {
            return Unlocked([&] { return MeasureField(*field.mesh, field.solution().frames); });
          },
          R"(quality(self)
--

Its FieldQuality: energies of the frames, error at the boundary, singular triangles.)")
      .def(
          "singular_curves", [](const TetField& field) { return Unlocked([&] { return CurvesOf(field); }); },
          R"(singular_curves(self)
--

Its SingularCurves: curves with type, valence, length and ends, and the nodes where they meet.)")
      .def(
          "tet_frames",
          [](const TetField& field) {
            return ArrayOf(Unlocked([&] { return TetFrames(*field.mesh, field.solution().frames); }));
          },
          R"(tet_frames(self)
--

(m, 3, 3) float64: one frame per tet, the mean of those of its corners.)")
      .def("sample", &Sample, py::arg("points"), R"(sample(self, points)
--

The field anywhere. Returns frames (k, 3, 3) float64, and (k,) bool: whether a tet contains the point. Outside it is the
frame of the nearest point of the boundary.

points: (k, 3) coordinates; fastest where each is near the one before.)")
      .def("write", &Write, py::arg("path"), R"(write(self, path)
--

Writes a .vtu file with the axes, the coefficients and the alignment, as the command octupole does, byte by byte.
The file appears when it is complete. Raises OSError when it cannot be written.)")
      .def(
          "write_fra",
          [](const TetField& field, const std::filesystem::path& path) {
            WithFile([&] { WriteFra(path, TetFrames(*field.mesh, field.solution().frames)); });
          },
          py::arg("path"), R"(write_fra(self, path)
--

Writes the tet_frames() as text (.fra), for hexahedral meshers such as CubeCover.)")
      .def(
          "write_quaternions",
          [](const TetField& field, const std::filesystem::path& path) {
            WithFile([&] { WriteQuaternions(path, field.solution().frames); });
          },
          py::arg("path"), R"(write_quaternions(self, path)
--

Writes one frame per vertex as text: w x y z.)")
      .def("write_singularities", &WriteCurves, py::arg("path"), R"(write_singularities(self, path)
--

Writes a .vtu file with the singular curves as lines, and nodes and singular points of the boundary as vertices.)");
  py::class_<SurfaceField, AnyField>(*module, "SurfaceField", "A cross field on a TriangleMesh.")
      .def_property_readonly("mesh",
                             [](const SurfaceField& field) { return std::const_pointer_cast<SurfaceMesh>(field.mesh); })
      .def(
          "crosses",
          [](const SurfaceField& field) {
            return ArrayOf(Unlocked([&] { return CrossField(*field.mesh, field.solution().frames); }));
          },
          R"(crosses(self)
--

(n, 3, 3) float64: the frames with their columns in the order tangent, tangent, normal, right-handed.)")
      .def(
          "quarter_indices",
          [](const SurfaceField& field) { return ArrayOf(Unlocked([&] { return IndicesOf(field); })); },
          R"(quarter_indices(self)
--

(m,) int32: four times the index of the cross field in each triangle, 0 where it is not singular.)")
      .def("write", &WriteCrosses, py::arg("path"), R"(write(self, path)
--

Writes a .vtu file with the axes, their alignment and the singular faces, as the command octupole surface does, byte by
byte. Raises OSError when it cannot be written.)");
}

}  // namespace

template <int kDegree>
FieldOptions<kDegree> OptionsFrom(const SolveArguments& arguments, Progress* progress) {
  FieldOptions<kDegree> options;
  options.method = FieldMethodOf(arguments.method);
  options.feature_angle_deg = arguments.feature_angle;
  options.open_boundary = OpenBoundaryOf(arguments.boundary);
  if (arguments.follow_regions) {
    options.regions = *arguments.follow_regions ? RegionUse::kFollow : RegionUse::kIgnore;
  }
  options.edge_weights = EdgeWeightsOf(arguments.weights);
  options.constraints = arguments.constraints;
  options.seed = arguments.seed;
  options.minimizer.num_starts = arguments.starts;
  options.minimizer.num_threads = arguments.threads;
  if (arguments.max_iterations) options.minimizer.max_iterations = *arguments.max_iterations;
  options.minimizer.callback = progress;
  const std::optional<SolverPreset> preset = SolverPresetOf(arguments.solver);
  if (!preset) return options;
  options.solver = MakeSolverOptions(*preset);
  options.solver->num_threads = arguments.threads;
  if (arguments.max_iterations) options.solver->max_num_iterations = *arguments.max_iterations;
  options.solver->callbacks.push_back(progress);
  return options;
}

template FieldOptions<3> OptionsFrom<3>(const SolveArguments& arguments, Progress* progress);
template FieldOptions<4> OptionsFrom<4>(const SolveArguments& arguments, Progress* progress);

void AddFields(py::module_* module) {
  AddQuality(module);
  AddCurves(module);
  AddFieldClasses(module);
  module->def(
      "_solve",
      [](const std::shared_ptr<TetMesh>& mesh, int degree, const std::string& method, double feature_angle,
         std::optional<bool> follow_regions, const std::string& weights, std::uint32_t seed, int starts, int threads,
         const std::string& solver, std::optional<int> max_iterations, const py::object& constraints,
         const py::object& start, const py::object& callback) {
        return TetField{{Solve(*mesh,
                               {degree, method, feature_angle, seed, starts, threads, solver, max_iterations, start,
                                "aligned", weights, follow_regions, ConstraintsFrom(constraints)},
                               callback)},
                        mesh,
                        nullptr};
      },
      py::arg("mesh"), py::kw_only(), py::arg("degree"), py::arg("method"), py::arg("feature_angle"),
      py::arg("follow_regions"), py::arg("weights"), py::arg("seed"), py::arg("starts"), py::arg("threads"),
      py::arg("solver"), py::arg("max_iterations"), py::arg("constraints"), py::arg("start"), py::arg("callback"));
  module->def(
      "_solve_surface",
      [](const std::shared_ptr<SurfaceMesh>& mesh, int degree, const std::string& method, double feature_angle,
         const std::string& boundary, const std::string& weights, std::uint32_t seed, int starts, int threads,
         const std::string& solver, std::optional<int> max_iterations, const py::object& constraints,
         const py::object& start, const py::object& callback) {
        return SurfaceField{
            {Solve<TriangleMesh>(*mesh,
                                 {degree, method, feature_angle, seed, starts, threads, solver, max_iterations, start,
                                  boundary, weights, std::nullopt, ConstraintsFrom(constraints)},
                                 callback)},
            mesh};
      },
      py::arg("mesh"), py::kw_only(), py::arg("degree"), py::arg("method"), py::arg("feature_angle"),
      py::arg("boundary"), py::arg("weights"), py::arg("seed"), py::arg("starts"), py::arg("threads"),
      py::arg("solver"), py::arg("max_iterations"), py::arg("constraints"), py::arg("start"), py::arg("callback"));
  module->def(
      "_solve_graph",
      [](const py::object& edges, const py::object& weights, const py::object& alignments, int degree,
         const std::string& method, std::uint32_t seed, int starts, int threads, const std::string& solver,
         std::optional<int> max_iterations, const py::object& start, const py::object& callback) {
        const double unused_angle = FieldOptions<3>().feature_angle_deg;
        return Solve(GraphFrom(edges, weights, alignments),
                     {degree, method, unused_angle, seed, starts, threads, solver, max_iterations, start}, callback);
      },
      py::arg("edges"), py::arg("weights"), py::arg("alignments"), py::kw_only(), py::arg("degree"), py::arg("method"),
      py::arg("seed"), py::arg("starts"), py::arg("threads"), py::arg("solver"), py::arg("max_iterations"),
      py::arg("start"), py::arg("callback"));
}

}  // namespace octupole::python
