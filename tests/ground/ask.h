#pragma once
// One query of a ground.

#include <surefoot/ground/ground.h>

namespace surefoot::test {

inline GroundHit ask(const Ground& ground, float x, float z, float y = 0, float up = 100, float down = 100) {
    const GroundQuery query{{x, y, z}, up, down};
    GroundHit hit;
    ground.query({&query, 1}, {&hit, 1});
    return hit;
}

}  // namespace surefoot::test
