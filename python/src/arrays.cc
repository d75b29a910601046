#include "arrays.h"

#include <limits>

namespace octupole::python {
namespace {

py::array ArrayFrom(py::handle object, const std::string& name, const char* kinds, const char* wanted) {
  py::array array = py::array::ensure(object);
  if (!array) throw py::type_error(name + ": " + wanted + " expected");
  if (array.size() > 0 && std::string(kinds).find(array.dtype().kind()) == std::string::npos) {
    throw py::type_error(name + ": " + wanted + " expected, not " + static_cast<std::string>(py::str(array.dtype())));
  }
  return array;
}

// 64-bit copies of what is narrower; unsigned 64-bit numbers that do not fit become negative, and so out of any range.
Integers<std::int64_t> WideIntegersFrom(py::handle object, const std::string& name) {
  return Integers<std::int64_t>::ensure(IntegersFrom(object, name));
}

int Narrow(std::int64_t value, const std::string& name, py::ssize_t index) {
  if (value >= std::numeric_limits<int>::min() && value <= std::numeric_limits<int>::max()) {
    return static_cast<int>(value);
  }
  throw std::invalid_argument(name + ": row " + std::to_string(index) + " has " + std::to_string(value));
}

}  // namespace

Reals RealsFrom(py::handle object, const std::string& name) {
  return Reals::ensure(ArrayFrom(object, name, "iuf", "real numbers"));
}

py::array IntegersFrom(py::handle object, const std::string& name) { return ArrayFrom(object, name, "iu", "integers"); }

std::string ShapeOf(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t k = 0; k < array.ndim(); ++k) text += (k > 0 ? ", " : "") + std::to_string(array.shape(k));
  return text + (array.ndim() == 1 ? ",)" : ")");
}

void CheckShape(const py::array& array, const std::string& name, const std::vector<py::ssize_t>& tail, bool is_list) {
  const auto num_leading = array.ndim() - static_cast<py::ssize_t>(tail.size());
  bool fits = is_list ? num_leading == 1 : num_leading >= 0;
  for (std::size_t k = 0; fits && k < tail.size(); ++k) {
    fits = array.shape(num_leading + static_cast<py::ssize_t>(k)) == tail[k];
  }
  if (fits) return;
  std::string wanted = is_list ? "(n" : "(...";
  for (const py::ssize_t n : tail) wanted += ", " + std::to_string(n);
  throw std::invalid_argument(name + ": the shape is " + ShapeOf(array) + ", not " + wanted +
                              (tail.empty() ? ",)" : ")"));
}

template <std::size_t kCount>
std::vector<std::array<int, kCount>> RowsFrom(py::handle object, const std::string& name) {
  const auto array = WideIntegersFrom(object, name);
  if (array.size() == 0) return {};
  CheckShape(array, name, {kCount}, /*is_list=*/true);
  std::vector<std::array<int, kCount>> rows(array.shape(0));
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    for (std::size_t k = 0; k < kCount; ++k) rows[i][k] = Narrow(array.data()[i * kCount + k], name, i);
  }
  return rows;
}

std::vector<int> ValuesFrom(py::handle object, const std::string& name) {
  const auto array = WideIntegersFrom(object, name);
  if (array.size() == 0) return {};
  CheckShape(array, name, {}, /*is_list=*/true);
  std::vector<int> values(array.size());
  for (py::ssize_t i = 0; i < array.size(); ++i) values[i] = Narrow(array.data()[i], name, i);
  return values;
}

std::vector<Eigen::Vector3d> PointsFrom(py::handle object, const std::string& name) {
  const Reals array = RealsFrom(object, name);
  CheckShape(array, name, {3}, /*is_list=*/true);
  std::vector<Eigen::Vector3d> points(array.shape(0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = Eigen::Map<const Eigen::Vector3d>(array.data() + 3 * i);
  }
  return points;
}

std::vector<Eigen::Matrix3d> FramesFrom(py::handle object, const std::string& name) {
  const Reals array = RealsFrom(object, name);
  CheckShape(array, name, {3, 3}, /*is_list=*/true);
  std::vector<Eigen::Matrix3d> frames(array.shape(0));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i] = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(array.data() + 9 * i);
  }
  return frames;
}

template std::vector<std::array<int, 2>> RowsFrom<2>(py::handle, const std::string&);
template std::vector<std::array<int, 3>> RowsFrom<3>(py::handle, const std::string&);

}  // namespace octupole::python
