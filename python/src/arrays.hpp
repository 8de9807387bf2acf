// SPDX-License-Identifier: BSD-3-Clause
// Arrays as arguments and results: checked by name, without a copy where NumPy's memory fits.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hinge::python {

/// An array of doubles in C order.
using Doubles = pybind11::array_t<double, pybind11::array::c_style>;

/// The length of each dimension that a caller may give; any: every length.
using Shape = std::vector<pybind11::ssize_t>;
inline constexpr pybind11::ssize_t any = -1;

/// Fills the gap after a small field of a structured array's row with zeros, so that equal rows have equal bytes.
template <std::size_t bytes>
struct Padding {
  std::int8_t zeros[bytes] = {};
};

/// Returns the shape as Python writes it, "(10, 3)"; `any` is written as "n".
std::string shape_text(std::span<const pybind11::ssize_t> shape);

/// Returns the value as doubles in C order: the array itself if it is one, otherwise a converted copy. name: the
/// argument, for messages. Throws TypeError unless the value holds real numbers.
Doubles as_doubles(pybind11::handle value, const char* name);
/// The same with a check of the shape: one of `shapes`. `meaning` names the dimensions, such as "(n, dof)". Throws
/// ValueError with the shape given and the shapes expected.
Doubles as_doubles(pybind11::handle value, const char* name, std::span<const Shape> shapes, const char* meaning);

/// Returns the value as a number, which may be infinite or NaN. Throws TypeError, with the argument, if it is none.
double as_number(pybind11::handle value, const char* name);

/// Returns the value as a length from 0 to 1e9. unit: for messages. Throws TypeError as as_number(), ValueError for
/// another number.
double as_length(pybind11::handle value, const char* name, const char* unit);

/// Throws ValueError, with the argument and the index of the first number that is not finite. Does not need the
/// interpreter's lock.
void require_finite(const Doubles& array, const char* name);

/// Returns the value as one-dimensional indices below `end`, from integers or from booleans (`end` of them, true for
/// those that are chosen). Throws TypeError for another type, ValueError for a wrong shape, IndexError for an index
/// outside 0 ... end - 1.
std::vector<std::size_t> as_indices(pybind11::handle value, const char* name, std::size_t end);

/// Configurations as an argument: one, of shape (dof,), or several, of shape (n, dof).
struct Configurations {
  Doubles array;     ///< keeps the memory alive
  const char* name;  ///< of the argument, for messages
  bool one = false;  ///< the argument has one dimension
  std::size_t count = 0, dof = 0;

  /// Configuration k < count. Throws as require_finite() does if one of its numbers is not finite.
  std::span<const double> operator[](std::size_t k) const;
  /// Configurations first ... last - 1, one after the other. Their numbers are not checked, because a further pass
  /// over a large array costs time: pass them only to functions that refuse numbers that are not finite.
  std::span<const double> slice(std::size_t first, std::size_t last) const {
    return {array.data() + first * dof, (last - first) * dof};
  }
};

/// Returns configurations of `dof` numbers each. name: the argument, for messages; it must outlive the result. Throws
/// TypeError and ValueError as as_doubles() does.
Configurations as_configurations(pybind11::handle value, const char* name, std::size_t dof);

/// Returns an array that owns the vector's memory. shape: its product is values.size().
template <class T>
pybind11::array_t<T> to_array(std::vector<T> values, std::vector<pybind11::ssize_t> shape) {
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  T* data = owned->data();
  const pybind11::capsule owner(owned.get(), [](void* pointer) { delete static_cast<std::vector<T>*>(pointer); });
  static_cast<void>(owned.release());
  return pybind11::array_t<T>(std::move(shape), data, owner);
}
/// The same in one dimension.
template <class T>
pybind11::array_t<T> to_array(std::vector<T> values) {
  const auto size = static_cast<pybind11::ssize_t>(values.size());
  return to_array(std::move(values), {size});
}

/// Returns rows of equal length, at least one, as an array of shape (rows, length).
pybind11::array_t<double> to_rows(const std::vector<std::vector<double>>& rows);

/// Returns bytes of 0 and 1 as an array of booleans that owns their memory.
pybind11::array to_booleans(std::vector<std::uint8_t> values);

/// Returns a read-only view of memory that `owner` keeps alive.
template <class T>
pybind11::array_t<T> view_of(const T* data, std::vector<pybind11::ssize_t> shape, pybind11::handle owner) {
  pybind11::array_t<T> view(std::move(shape), data, owner);
  view.attr("flags").attr("writeable") = false;
  return view;
}

}  // namespace hinge::python
