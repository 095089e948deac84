#include <surefoot/preset/default_set.h>

#include "tests/support/clip_set_tests.h"

surefoot::ClipSet surefoot::make_tested_set() { return make_default_set(); }
