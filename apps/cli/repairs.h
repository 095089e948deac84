#pragma once
// How `author --fix` and `fix` tell what was repaired.

#include <surefoot/author/repair.h>

namespace surefoot::cli {

/// What was done, what could not be and why, and the findings before and after by rule, on standard output.
void print_repairs(const RepairReport& report);

}  // namespace surefoot::cli
