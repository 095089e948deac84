#include "shared_inline.h"

int gate_use_a(int x) { return gate_shared_inline(x); }
