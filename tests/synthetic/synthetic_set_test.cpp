#include <surefoot/synthetic/gait_cycle.h>
#include <surefoot/synthetic/synthetic_set.h>

#include "tests/support/clip_set_tests.h"

namespace surefoot {

ClipSet make_tested_set() { return make_synthetic_set(); }

namespace {

TEST(PeriodicCurve, is_flat_between_equal_keys_and_never_overshoots) {
    const PeriodicCurve curve({{0.0f, 2}, {0.2f, 0}, {0.5f, 0}, {0.8f, -3}});
    for (int i = 0; i <= 100; ++i) {
        const float phase = 0.01f * static_cast<float>(i);
        EXPECT_LE(curve(phase), 2.00001f);
        EXPECT_GE(curve(phase), -3.00001f);
        if (phase >= 0.21f && phase <= 0.49f) {
            EXPECT_EQ(curve(phase), 0);
        }
        EXPECT_NEAR(curve(phase), curve(phase + 3), 1e-4f);
    }
    EXPECT_EQ(curve(0.8f), -3);
}

}  // namespace
}  // namespace surefoot
