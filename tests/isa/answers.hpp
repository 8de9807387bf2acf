// SPDX-License-Identifier: BSD-3-Clause
// Declarations that main.cpp can use before it knows that this CPU can run answers.cpp.
#pragma once

extern "C" {
/// The hinge::detail::simd::InstructionSet of answers.cpp as a number. It is data: reading it runs no code.
extern const unsigned char needed_instruction_set;

/// Runs all queries, prints differences from the stored hashes, and returns their number.
int compare_answers();
}
