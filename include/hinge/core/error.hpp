// SPDX-License-Identifier: BSD-3-Clause
// The exceptions that Hinge throws. Each message names the faulty element, its value and the expected value.
#pragma once

#include <stdexcept>

#include "hinge/core/api.hpp"

namespace hinge {

/// Base class of every exception that Hinge itself throws.
struct HINGE_API Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file could not be read. The message names the file, the line and the entity.
struct HINGE_API LoadError : Error {
  using Error::Error;
};

/// A model, a pair filter, a distance matrix or a DOF selection is invalid.
struct HINGE_API ModelError : Error {
  using Error::Error;
};

/// A configuration, a pose or a coordinate passed to an update or a query is invalid. The object keeps its previous
/// state.
struct HINGE_API ConfigurationError : Error {
  using Error::Error;
};

}  // namespace hinge
