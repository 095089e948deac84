#pragma once
// Our own sine, cosine, arcs and exponential: only + - * / and square roots, so that every build gives the same bits
// (libm differs between systems, and a gate forbids it under surefoot/). Angles in radians.
//
// The double functions are good to about 1 ulp for |angle| < 1e5; the float overloads round them and are meant for
// tools. Lanes have their own (math/lanes.h).

#include <cmath>

namespace surefoot {

inline constexpr double k_pi = 3.14159265358979323846;
inline constexpr float k_degrees_per_radian = static_cast<float>(180.0 / k_pi);
inline constexpr float k_radians_per_degree = static_cast<float>(k_pi / 180.0);

double sin(double x) noexcept;
double cos(double x) noexcept;
/// Both at little more than the price of one; the same bits as sin and cos.
struct SinCos {
    double sin, cos;
};
SinCos sin_cos(double x) noexcept;
double tan(double x) noexcept;
double asin(double x) noexcept;  ///< argument clamped to [-1, 1]
double acos(double x) noexcept;  ///< argument clamped to [-1, 1]
double atan2(double y, double x) noexcept;
double exp(double x) noexcept;
double log(double x) noexcept;  ///< x > 0

inline float sin(float x) noexcept { return static_cast<float>(sin(static_cast<double>(x))); }
inline float cos(float x) noexcept { return static_cast<float>(cos(static_cast<double>(x))); }
inline float tan(float x) noexcept { return static_cast<float>(tan(static_cast<double>(x))); }
inline float asin(float x) noexcept { return static_cast<float>(asin(static_cast<double>(x))); }
inline float acos(float x) noexcept { return static_cast<float>(acos(static_cast<double>(x))); }
inline float atan2(float y, float x) noexcept {
    return static_cast<float>(atan2(static_cast<double>(y), static_cast<double>(x)));
}
inline float exp(float x) noexcept { return static_cast<float>(exp(static_cast<double>(x))); }

/// The same angle in (-pi, pi].
double wrap_angle(double radians) noexcept;
inline float wrap_angle(float radians) noexcept { return static_cast<float>(wrap_angle(static_cast<double>(radians))); }

}  // namespace surefoot
