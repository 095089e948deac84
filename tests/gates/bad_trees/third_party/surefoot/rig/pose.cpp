// A runtime room with a library, a stream and a thread; an authoring header that forces a library on its readers.
#include <Eigen/Core>
#include <fstream>
#include <thread>
#include <immintrin.h>
