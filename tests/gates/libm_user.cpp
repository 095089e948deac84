// A library that must not pass the gate: it asks libm for a sine and a power.
#include <cmath>

double gate_sine(double x) { return std::sin(x); }
float gate_power(float x, float y) { return std::pow(x, y); }
