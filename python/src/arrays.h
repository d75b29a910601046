#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// Between NumPy's arrays and the library's vectors. Results are views of the library's memory, without a copy.
namespace octupole::python {

namespace py = pybind11;

/// How one element of a vector looks to NumPy: the scalars in it, the shape and the strides in bytes behind the first.
template <typename Element>
struct ElementLayout;

template <>
struct ElementLayout<int> {
  using Scalar = std::int32_t;
  static std::vector<py::ssize_t> shape() { return {}; }
  static std::vector<py::ssize_t> strides() { return {}; }
};

template <>
struct ElementLayout<double> {
  using Scalar = double;
  static std::vector<py::ssize_t> shape() { return {}; }
  static std::vector<py::ssize_t> strides() { return {}; }
};

template <>
struct ElementLayout<std::uint8_t> {
  using Scalar = bool;
  static std::vector<py::ssize_t> shape() { return {}; }
  static std::vector<py::ssize_t> strides() { return {}; }
};

template <std::size_t kCount>
struct ElementLayout<std::array<int, kCount>> {
  using Scalar = std::int32_t;
  static std::vector<py::ssize_t> shape() { return {kCount}; }
  static std::vector<py::ssize_t> strides() { return {sizeof(int)}; }
};

/// Column vectors have one dimension, matrices two; Eigen stores columns one after the other.
template <int kRows, int kColumns>
struct ElementLayout<Eigen::Matrix<double, kRows, kColumns>> {
  using Scalar = double;
  static std::vector<py::ssize_t> shape() {
    return kColumns == 1 ? std::vector<py::ssize_t>{kRows} : std::vector<py::ssize_t>{kRows, kColumns};
  }
  static std::vector<py::ssize_t> strides() {
    constexpr py::ssize_t kSize = sizeof(double);
    return kColumns == 1 ? std::vector<py::ssize_t>{kSize} : std::vector<py::ssize_t>{kSize, kRows * kSize};
  }
};

/// `elements` as an array of shape (..., element), a view that keeps `owner` alive and that nobody can write to.
/// `leading` is the shape of what the vector holds one after the other.
template <typename Element>
py::array ViewOf(const std::vector<Element>& elements, const std::vector<py::ssize_t>& leading, py::handle owner) {
  using Layout = ElementLayout<Element>;
  std::vector<py::ssize_t> shape = leading, strides(leading.size());
  py::ssize_t stride = sizeof(Element);
  for (std::size_t k = leading.size(); k-- > 0; stride *= leading[k]) strides[k] = stride;
  for (const py::ssize_t n : Layout::shape()) shape.push_back(n);
  for (const py::ssize_t n : Layout::strides()) strides.push_back(n);
  const auto* first = reinterpret_cast<const typename Layout::Scalar*>(elements.data());
  py::array_t<typename Layout::Scalar> view(shape, strides, first, owner);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return std::move(view);
}

template <typename Element>
py::array ViewOf(const std::vector<Element>& elements, py::handle owner) {
  return ViewOf(elements, {static_cast<py::ssize_t>(elements.size())}, owner);
}

/// A vector that nobody else has, as an array that owns it and may be written to.
template <typename Element>
py::array ArrayOf(std::vector<Element> elements, const std::vector<py::ssize_t>& leading) {
  auto* owned = new std::vector<Element>(std::move(elements));
  const py::capsule owner(owned, [](void* p) { delete static_cast<std::vector<Element>*>(p); });
  py::array view = ViewOf(*owned, leading, owner);
  py::detail::array_proxy(view.ptr())->flags |= py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

template <typename Element>
py::array ArrayOf(std::vector<Element> elements) {
  const auto count = static_cast<py::ssize_t>(elements.size());
  return ArrayOf(std::move(elements), {count});
}

/// A C-contiguous array of doubles or integers, made without a copy from one that is such already.
using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;
template <typename Integer>
using Integers = py::array_t<Integer, py::array::c_style | py::array::forcecast>;

/// Anything that NumPy makes an array of real numbers of. \throw py::type_error naming `name` for anything else.
Reals RealsFrom(py::handle object, const std::string& name);

/// Anything that NumPy makes an array of integers of, as it is. \throw py::type_error naming `name` for anything else.
py::array IntegersFrom(py::handle object, const std::string& name);

/// "(12, 3)", for messages.
std::string ShapeOf(const py::array& array);

/// \throw std::invalid_argument unless the array has the shape (..., tail); with `is_list` exactly (n, tail).
void CheckShape(const py::array& array, const std::string& name, const std::vector<py::ssize_t>& tail, bool is_list);

/// The rows of an array of shape (n, kCount). \throw py::type_error, std::invalid_argument naming `name`.
template <std::size_t kCount>
std::vector<std::array<int, kCount>> RowsFrom(py::handle object, const std::string& name);

/// The values of an array of shape (n,). Errors likewise.
std::vector<int> ValuesFrom(py::handle object, const std::string& name);

/// The points of an array of shape (n, 3). Errors likewise.
std::vector<Eigen::Vector3d> PointsFrom(py::handle object, const std::string& name);

/// The matrices of an array of shape (n, 3, 3). Errors likewise.
std::vector<Eigen::Matrix3d> FramesFrom(py::handle object, const std::string& name);

}  // namespace octupole::python
