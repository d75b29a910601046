#include <pybind11/stl.h>

#include <cmath>

#include "arrays.h"
#include "bindings.h"
#include "octupole/frames/frame.h"
#include "octupole/frames/fundamental_zone.h"
#include "octupole/harmonics/degree_map.h"
#include "octupole/harmonics/harmonics.h"
#include "octupole/harmonics/quadrics.h"
#include "octupole/harmonics/rotation.h"

namespace octupole::python {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// The shape of an array without the last `num` dimensions.
std::vector<py::ssize_t> LeadingShape(const py::array& array, py::ssize_t num) {
  return {array.shape(), array.shape() + array.ndim() - num};
}

py::ssize_t CountOf(const std::vector<py::ssize_t>& shape) {
  py::ssize_t count = 1;
  for (const py::ssize_t n : shape) count *= n;
  return count;
}

// f(i) for every element, as an array of shape (leading, result). An exception says which element it was.
template <typename Function>
py::array Map(const char* name, const std::vector<py::ssize_t>& leading, const Function& f) {
  std::vector<decltype(f(py::ssize_t(0)))> results;
  const py::ssize_t count = CountOf(leading);
  Unlocked([&] {
    results.reserve(count);
    for (py::ssize_t i = 0; i < count; ++i) {
      try {
        results.push_back(f(i));
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(std::string(name) + ": element " + std::to_string(i) + ": " + error.what());
      }
    }
  });
  return ArrayOf(std::move(results), leading);
}

// Calls f(degree), the degree as a type.
template <typename Function>
py::array WithDegree(int degree, const Function& f) {
  switch (degree) {
    case 3:
      return f(std::integral_constant<int, 3>());
    case 4:
      return f(std::integral_constant<int, 4>());
    default:
      throw std::invalid_argument("degree: 3 or 4 expected, not " + std::to_string(degree));
  }
}

// Calls f with the degree that the last dimension, 7 or 9, tells.
template <typename Function>
py::array WithDegreeOf(const Reals& harmonics, const Function& f) {
  const py::ssize_t size = harmonics.ndim() == 0 ? 0 : harmonics.shape(harmonics.ndim() - 1);
  if (size != 7 && size != 9) {
    throw std::invalid_argument("h: the shape is " + ShapeOf(harmonics) + ", not (..., 7) or (..., 9)");
  }
  return WithDegree(size == 7 ? 3 : 4, f);
}

template <int kDegree>
Harmonic<kDegree> HarmonicAt(const Reals& harmonics, py::ssize_t i) {
  return Eigen::Map<const Harmonic<kDegree>>(harmonics.data() + i * kDimension<kDegree>);
}

Eigen::Matrix3d MatrixAt(const Reals& matrices, py::ssize_t i) {
  return Eigen::Map<const RowMajorMatrix>(matrices.data() + 9 * i);
}

Reals MatricesFrom(const py::object& object, const char* name) {
  Reals matrices = RealsFrom(object, name);
  CheckShape(matrices, name, {3, 3}, /*is_list=*/false);
  return matrices;
}

// f of the frames of two arrays, whose leading dimensions are broadcast as NumPy does.
template <typename Function>
py::array MapPairs(const char* name, const py::object& a, const py::object& b, const Function& f) {
  Reals first = MatricesFrom(a, "R"), second = MatricesFrom(b, "Q");
  const py::tuple both = py::module_::import("numpy").attr("broadcast_arrays")(first, second);
  first = Reals(both[0]);
  second = Reals(both[1]);
  return Map(name, LeadingShape(first, 2), [&](py::ssize_t i) { return f(MatrixAt(first, i), MatrixAt(second, i)); });
}

py::array NearestFrameOf(const py::object& h) {
  const Reals harmonics = RealsFrom(h, "h");
  return WithDegreeOf(harmonics, [&](auto constant) {
    return Map("nearest_frame", LeadingShape(harmonics, 1),
               [&](py::ssize_t i) { return NearestFrame<constant.value>(HarmonicAt<constant.value>(harmonics, i)); });
  });
}

py::array DeviationOf(const py::object& h) {
  const Reals harmonics = RealsFrom(h, "h");
  return WithDegreeOf(harmonics, [&](auto constant) {
    return Map("deviation", LeadingShape(harmonics, 1),
               [&](py::ssize_t i) { return Deviation<constant.value>(HarmonicAt<constant.value>(harmonics, i)); });
  });
}

py::array HarmonicOf(const py::object& frames, int degree) {
  const Reals matrices = MatricesFrom(frames, "R");
  return WithDegree(degree, [&](auto constant) {
    return Map("harmonic_of_frame", LeadingShape(matrices, 2),
               [&](py::ssize_t i) { return HarmonicFromFrame<constant.value>(MatrixAt(matrices, i)); });
  });
}

py::array RotationOf(const py::object& rotations, int degree) {
  const Reals matrices = MatricesFrom(rotations, "R");
  return WithDegree(degree, [&](auto constant) {
    return Map("rotation_matrix", LeadingShape(matrices, 2),
               [&](py::ssize_t i) { return HarmonicRotation<constant.value>(MatrixAt(matrices, i)); });
  });
}

py::array BasisAt(const py::object& directions, int degree) {
  const Reals vectors = RealsFrom(directions, "directions");
  CheckShape(vectors, "directions", {3}, /*is_list=*/false);
  return WithDegree(degree, [&](auto constant) {
    return Map("harmonic_basis", LeadingShape(vectors, 1), [&](py::ssize_t i) {
      return EvaluateBasis<constant.value>(Eigen::Map<const Eigen::Vector3d>(vectors.data() + 3 * i));
    });
  });
}

py::array HexadecapoleOf(const py::object& octupoles) {
  const Reals harmonics = RealsFrom(octupoles, "a");
  CheckShape(harmonics, "a", {7}, /*is_list=*/false);
  return Map("hexadecapole_of_octupole", LeadingShape(harmonics, 1),
             [&](py::ssize_t i) { return HexadecapoleFromOctupole(HarmonicAt<3>(harmonics, i)); });
}

py::array DifferenceOf(const py::object& a, const py::object& b, int degree) {
  return WithDegree(degree, [&](auto constant) {
    return MapPairs("frame_difference", a, b, [constant](const Eigen::Matrix3d& r, const Eigen::Matrix3d& q) {
      return FrameDifference<constant.value>(r, q);
    });
  });
}

py::array AngleOf(const py::object& a, const py::object& b) {
  return MapPairs("frame_angle", a, b, [](const Eigen::Matrix3d& r, const Eigen::Matrix3d& q) {
    return AngleBetween(r, q, SymmetryGroup::kOctahedral) * 180 / M_PI;
  });
}

}  // namespace

void AddMathematics(py::module_* module) {
  module->def("nearest_frame", &NearestFrameOf, py::arg("h"), R"(nearest_frame(h)
--

The frames whose harmonics are nearest to h: the global maximum of the inner product over all rotations.

h: (..., 7) octupoles or (..., 9) hexadecapoles, of any length but zero.
Returns (..., 3, 3) rotations, whose columns are the axes.
Raises ValueError naming the first element that is zero or not finite.)");
  module->def("harmonic_of_frame", &HarmonicOf, py::arg("R"), py::arg("degree") = 3,
              R"(harmonic_of_frame(R, degree=3)
--

The unit harmonics of frames, in degree 3 up to sign.

R: (..., 3, 3) rotations, whose columns are the axes.
Returns (..., 7) or, in degree 4, (..., 9).
Raises ValueError naming the first element that is no rotation to 1e-6.)");
  module->def("rotation_matrix", &RotationOf, py::arg("R"), py::arg("degree") = 3, R"(rotation_matrix(R, degree=3)
--

How rotations act on the coefficients of a harmonic: D(R) h are those of x -> f(R^-1 x) when h are those of f.

R: (..., 3, 3) rotations.
Returns (..., 7, 7) or, in degree 4, (..., 9, 9) orthogonal matrices.
Raises ValueError naming the first element that is no rotation to 1e-6.)");
  module->def("deviation", &DeviationOf, py::arg("h"), R"(deviation(h)
--

How far harmonics are from being those of frames: the sum of five squared quadrics, zero exactly on the multiples of
harmonics of frames, homogeneous of degree 4.

h: (..., 7) octupoles or (..., 9) hexadecapoles.
Returns an array of shape (...).)");
  module->def("harmonic_basis", &BasisAt, py::arg("directions"), py::arg("degree") = 3,
              R"(harmonic_basis(directions, degree=3)
--

The basis functions at directions, as homogeneous polynomials: a vector of length r gives r^degree times as much as the
unit vector. The harmonic of coefficients h has there the values harmonic_basis(directions, degree) @ h.

directions: (..., 3).
Returns (..., 7) or, in degree 4, (..., 9): the real orthonormal harmonics of order m = -degree .. degree.)");
  module->def("hexadecapole_of_octupole", &HexadecapoleOf, py::arg("a"), R"(hexadecapole_of_octupole(a)
--

The quadratic map from degree 3 to degree 4 that takes the octupole of a frame to the hexadecapole of the same frame.

a: (..., 7) octupoles.
Returns (..., 9).)");
  module->def("frame_difference", &DifferenceOf, py::arg("R"), py::arg("Q"), py::arg("degree") = 4,
              R"(frame_difference(R, Q, degree=4)
--

The smoothness term between frames, blind to the order and signs of their axes: 20/3 t^2 for frames a small angle t
(radians) apart; in degree 3 it is 16 t^2.

R, Q: (..., 3, 3) rotations, broadcast against each other.
Returns an array of shape (...).)");
  module->def("frame_angle", &AngleOf, py::arg("R"), py::arg("Q"), R"(frame_angle(R, Q)
--

The smallest angle in degrees by which one frame turns into the other, at most about 62.8.

R, Q: (..., 3, 3) rotations, broadcast against each other.
Returns an array of shape (...).)");
}

}  // namespace octupole::python
