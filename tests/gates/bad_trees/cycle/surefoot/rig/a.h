#pragma once
#include <surefoot/rig/b.h>
