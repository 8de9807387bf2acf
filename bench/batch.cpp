// SPDX-License-Identifier: BSD-3-Clause
// Neighbouring conformations sixteen at a time against one query each: 1MBN, yes/no, answers compared.
#include "batch.hpp"

int main() { return hinge::bench::print_batches() == 0 ? 0 : 1; }
