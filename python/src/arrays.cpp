// SPDX-License-Identifier: BSD-3-Clause
// Checks and converts array arguments.
#include "arrays.hpp"

#include <algorithm>

#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"

namespace hinge::python {

namespace py = pybind11;

std::string shape_text(std::span<const py::ssize_t> shape) {
  std::string text = "(";
  for (std::size_t k = 0; k < shape.size(); ++k) {
    if (k > 0) text += ", ";
    text += shape[k] == any ? "n" : std::to_string(shape[k]);
  }
  return text + (shape.size() == 1 ? ",)" : ")");
}

Doubles as_doubles(py::handle value, const char* name) {
  if (Doubles::check_(value)) return py::reinterpret_borrow<Doubles>(value);
  const auto refuse = [&](const std::string& what) {
    throw py::type_error(std::string(name) + ": " + what + ", expected an array of real numbers");
  };
  if (value.is_none()) refuse("None");
  const py::array array = py::array::ensure(value);  // clears Python's error
  if (!array) refuse("a " + std::string(py::str(py::type::of(value).attr("__name__"))));
  const char kind = array.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u' && array.size() > 0)
    refuse("an array of " + std::string(py::str(array.dtype())));
  auto converted = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!converted) refuse("an array of " + std::string(py::str(array.dtype())));
  return converted;
}

Doubles as_doubles(py::handle value, const char* name, std::span<const Shape> shapes, const char* meaning) {
  Doubles array = as_doubles(value, name);
  const std::span<const py::ssize_t> given(array.shape(), static_cast<std::size_t>(array.ndim()));
  const auto fits = [&](const Shape& wanted) {
    return std::equal(given.begin(), given.end(), wanted.begin(), wanted.end(),
                      [](py::ssize_t length, py::ssize_t expected) { return expected == any || length == expected; });
  };
  if (std::none_of(shapes.begin(), shapes.end(), fits)) {
    std::string text = std::string(name) + ": shape " + shape_text(given) + ", expected ";
    for (std::size_t k = 0; k < shapes.size(); ++k) text += (k > 0 ? " or " : "") + shape_text(shapes[k]);
    throw py::value_error(text + ", which is " + meaning);
  }
  return array;
}

double as_number(py::handle value, const char* name) {
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() == nullptr) return number;
  PyErr_Clear();
  throw py::type_error(std::string(name) + ": a " + std::string(py::str(py::type::of(value).attr("__name__"))) +
                       ", expected a number");
}

py::array_t<double> to_rows(const std::vector<std::vector<double>>& rows) {
  std::vector<double> values;
  for (const std::vector<double>& row : rows) values.insert(values.end(), row.begin(), row.end());
  return to_array(std::move(values),
                  {static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(rows.front().size())});
}

double as_length(py::handle value, const char* name, const char* unit) {
  const double length = as_number(value, name);
  if (length >= 0.0 && length <= 1e9) return length;
  throw py::value_error(std::string(name) + ": " + py::repr(py::float_(length)).cast<std::string>() +
                        ", expected a length from 0 to 1e9 " + unit);
}

void require_finite(const Doubles& array, const char* name) {
  const double* data = array.data();
  const auto size = static_cast<std::size_t>(array.size());
  if (is_finite(std::span(data, size))) return;
  for (std::size_t k = 0; k < size; ++k) {
    if (is_finite(data[k])) continue;
    std::string place;
    std::size_t rest = k;
    for (py::ssize_t d = array.ndim() - 1; d >= 0; --d) {
      const auto length = static_cast<std::size_t>(array.shape(d));
      place = std::to_string(rest % length) + (place.empty() ? "" : ", ") + place;
      rest /= length;
    }
    throw py::value_error(std::string(name) + "[" + place + "] is " + number_text(data[k]) +
                          ", expected finite numbers");
  }
}

std::vector<std::size_t> as_indices(py::handle value, const char* name, std::size_t end) {
  const py::array array = py::array::ensure(value);
  const char kind = array ? array.dtype().kind() : 'O';
  if (kind != 'b' && kind != 'i' && kind != 'u' && !(array && array.size() == 0))
    throw py::type_error(std::string(name) + ": expected an array of integers or booleans");
  if (array.ndim() != 1)
    throw py::value_error(std::string(name) + ": " + std::to_string(array.ndim()) + " dimensions, expected 1");
  std::vector<std::size_t> indices;
  if (kind == 'b') {
    const auto flags = py::array_t<bool, py::array::c_style | py::array::forcecast>::ensure(array);
    if (static_cast<std::size_t>(flags.size()) != end)
      throw py::value_error(std::string(name) + ": " + std::to_string(flags.size()) + " booleans, expected " +
                            std::to_string(end));
    for (std::size_t k = 0; k < end; ++k)
      if (flags.data()[k]) indices.push_back(k);
    return indices;
  }
  const auto numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(array);
  for (py::ssize_t k = 0; k < numbers.size(); ++k) {
    const std::int64_t number = numbers.data()[k];
    if (number < 0 || static_cast<std::size_t>(number) >= end)
      throw py::index_error(std::string(name) + "[" + std::to_string(k) + "] is " + std::to_string(number) +
                            ", expected 0 to " + std::to_string(end) + " - 1");
    indices.push_back(static_cast<std::size_t>(number));
  }
  return indices;
}

std::span<const double> Configurations::operator[](std::size_t k) const {
  const std::span<const double> numbers = slice(k, k + 1);
  if (!is_finite(numbers)) require_finite(array, name);
  return numbers;
}

Configurations as_configurations(py::handle value, const char* name, std::size_t dof) {
  Configurations all{as_doubles(value, name), name};
  all.dof = dof;
  const auto columns = static_cast<py::ssize_t>(dof);
  const py::ssize_t dimensions = all.array.ndim();
  if ((dimensions != 1 && dimensions != 2) || all.array.shape(dimensions - 1) != columns) {
    const std::span<const py::ssize_t> given(all.array.shape(), static_cast<std::size_t>(dimensions));
    throw py::value_error(std::string(name) + ": shape " + shape_text(given) + ", expected " +
                          shape_text(Shape{any, columns}) + " or " + shape_text(Shape{columns}) +
                          ", one value per degree of freedom");
  }
  all.one = dimensions == 1;
  all.count = all.one ? 1 : static_cast<std::size_t>(all.array.shape(0));
  return all;
}

py::array to_booleans(std::vector<std::uint8_t> values) {
  return to_array(std::move(values)).attr("view")(py::dtype::of<bool>());
}

}  // namespace hinge::python
