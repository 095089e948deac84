#include <cmath>
// std::cos(x) in a comment is no call.
namespace surefoot {
const char* text = "std::tan(x)";
double fine(double x) { return sin(x) + std::sqrt(x) + std::floor(x); }
double line_6(double x) { return std::sin(x); }
double line_7(double x) { return ::sin(x); }
double line_8(double x) { return pow(x, 3.0); }
float line_9(float x) { return atan2f(x, 1.0f); }
double line_10(double x) { return __builtin_exp(x); }
using std::cos;
}  // namespace surefoot
