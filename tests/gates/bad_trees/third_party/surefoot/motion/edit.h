#pragma once
#include <surefoot/motion/clip.h>
