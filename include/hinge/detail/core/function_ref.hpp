// SPDX-License-Identifier: BSD-3-Clause
// FunctionRef: a callable without its type, so that a long function is compiled once and not for every callable.
#pragma once

#include <memory>
#include <type_traits>

namespace hinge::detail {

/// Refers to a callable that must outlive it: use it for parameters only. A call costs one indirect call.
template <class Signature>
class FunctionRef;

template <class R, class... Args>
class FunctionRef<R(Args...)> {
 public:
  template <class F>
  requires(!std::is_same_v<F, FunctionRef> && std::is_invocable_r_v<R, const F&, Args...>)
      FunctionRef(const F& callable)
  noexcept
      : callable_(std::addressof(callable)),
        call_([](const void* f, Args... args) -> R { return (*static_cast<const F*>(f))(args...); }) {}

  R operator()(Args... args) const { return call_(callable_, args...); }

 private:
  const void* callable_;
  R (*call_)(const void*, Args...);
};

}  // namespace hinge::detail
