// This one may.
#include <surefoot/motion/clip.h>
