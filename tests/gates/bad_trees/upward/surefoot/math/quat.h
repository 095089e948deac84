#pragma once
/* A room that reaches for one below it. */
#include <surefoot/rig/pose.h>
