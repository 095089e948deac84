#pragma once
// Counts what a test program allocates. A program that wants it adds tests/support/allocations.cpp to its sources (in
// its libraries.cmake), which replaces operator new.

namespace surefoot::test {

/// Allocations by operator new since the program began.
long allocation_count();

}  // namespace surefoot::test
