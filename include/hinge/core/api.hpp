// SPDX-License-Identifier: BSD-3-Clause
// HINGE_API: marks what the libraries hinge_molecular and hinge_robotics export. Their other symbols are hidden.
#pragma once

#if defined(__GNUC__)
/// Makes a class or function visible outside its shared library.
#define HINGE_API __attribute__((visibility("default")))
#else
#define HINGE_API
#endif
