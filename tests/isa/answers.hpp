// SPDX-License-Identifier: BSD-3-Clause
// What main.cpp may know of answers.cpp before it is sure that this CPU runs it.
#pragma once

extern "C" {
/// The hinge::detail::simd::InstructionSet answers.cpp was compiled for, as a number. Data: looking at it runs no code.
extern const unsigned char needed_instruction_set;

/// Asks everything and prints what differs from the literals; the number of differences.
int compare_answers();
}
