// SPDX-License-Identifier: BSD-3-Clause
// Casters of bound classes that reject an object whose __init__ has not run. pybind11's own caster would allocate
// uninitialised memory for it. A class opts in with the member `using MadeByInit = void`.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

namespace hinge::python {

/// Throws TypeError, with the name of the class, if __init__ of the object has not run.
inline void require_made(const pybind11::detail::value_and_holder& object) {
  if (object.value_ptr() != nullptr) return;
  const std::string name = Py_TYPE(reinterpret_cast<PyObject*>(object.inst))->tp_name;
  throw pybind11::type_error(name + ": an object whose __init__() has not been called, expected an initialised one");
}

template <class T>
inline constexpr bool made_by_init = requires {
  typename T::MadeByInit;
};

}  // namespace hinge::python

namespace pybind11::detail {

template <class T>
class type_caster<T, enable_if_t<hinge::python::made_by_init<T>>> : public type_caster_base<T> {
 public:
  using type_caster_base<T>::type_caster_base;
  bool load(handle source, bool convert) {
    return type_caster_base<T>::template load_impl<type_caster>(source, convert);
  }
  void load_value(value_and_holder&& object) {  // hides the function of the base, which load_impl() would call
    hinge::python::require_made(object);
    type_caster_base<T>::load_value(static_cast<value_and_holder&&>(object));
  }
};

template <class T>
requires hinge::python::made_by_init<T>
class type_caster<std::shared_ptr<T>> : public copyable_holder_caster<T, std::shared_ptr<T>> {
  using Base = copyable_holder_caster<T, std::shared_ptr<T>>;

 public:
  using Base::Base;
  bool load(handle source, bool convert) { return Base::template load_impl<type_caster>(source, convert); }

 private:
  friend class type_caster_generic;
  bool load_value(value_and_holder&& object) {
    hinge::python::require_made(object);
    return Base::load_value(static_cast<value_and_holder&&>(object));
  }
};

}  // namespace pybind11::detail
