#pragma once
// Up and down a course: what to ask a character for that is to walk its middle line (x = 0) to the far end, turn round,
// come back, and so on.

#include <surefoot/graph/locomotion.h>

namespace surefoot {

class Patrol {
  public:
    /// Between z = 0 and z = `length` [m].
    explicit Patrol(float length) : length_(length) {}

    /// From where it is now, at `speed` [m/s]; slower where it has to turn round.
    LocomotionRequest ask(const RootFrame& root, float speed) noexcept;

  private:
    float length_;
    bool back_ = false;
};

}  // namespace surefoot
