#pragma once
double sin(double x) noexcept;
