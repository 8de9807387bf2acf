// SPDX-License-Identifier: BSD-3-Clause
// The exceptions Hinge throws. Each message names the element at fault, its value and what was expected.
#pragma once

#include <stdexcept>

namespace hinge {

/// Base of everything Hinge throws on purpose.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A file could not be read: the message names file, line and entity.
struct LoadError : Error {
  using Error::Error;
};

/// A model, filter, matrix or selection is not acceptable.
struct ModelError : Error {
  using Error::Error;
};

/// A configuration, pose or coordinate given to update() is not acceptable; the previous state is kept.
struct ConfigurationError : Error {
  using Error::Error;
};

}  // namespace hinge
