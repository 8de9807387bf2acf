// SPDX-License-Identifier: BSD-3-Clause
// Yes/no queries on 1MBN: blocks of sixteen neighbouring conformations against single queries, answers compared.
#include "batch.hpp"

int main() { return hinge::bench::print_batches() == 0 ? 0 : 1; }
