#pragma once
// An inline function that two objects compile, so that the linker keeps whichever came first.
inline __attribute__((noinline)) int gate_shared_inline(int x) { return 3 * x + 1; }
