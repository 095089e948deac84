// No guard, and every way around the gate.
#include "../rig/pose.h"
#define HIDDEN <surefoot/rig/pose.h>
#include HIDDEN
#include <surefoot/rig/missing.h>
// #include <surefoot/motion/not_a_breach.h>
