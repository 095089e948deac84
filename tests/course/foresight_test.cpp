// What walkers foresee.

#include <surefoot/course/foresight.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

/// Not linear in its steps, so that another way to the same moment shows.
struct Counter {
    float value = 1;
};

struct Looker {
    Foresight<Counter> foresight;
    int gone = 0;
    explicit Looker(float now = 1) { foresight.begin({now}); }
    float look(float ahead) {
        const auto go = [this](Counter& counter, float dt) {
            counter.value += counter.value * dt;
            ++gone;
        };
        return foresight.at(ahead, go).value;
    }
};

TEST(Foresight, sees_the_same_in_whatever_order_it_looks) {
    const float moments[] = {0.7f, 0.1f, 0.30001f, 1.1f, 0, 0.3f, 0.1f};
    Looker one;
    for (const float ahead : moments) EXPECT_EQ(one.look(ahead), Looker().look(ahead)) << ahead;
}

TEST(Foresight, goes_no_step_twice) {
    Looker looker;
    looker.look(1);
    const int gone = looker.gone;
    for (const float ahead : {0.2f, 0.9f, 0.5f}) looker.look(ahead);
    EXPECT_EQ(looker.gone, gone + 3);  // the arrivals
}

TEST(Foresight, forgets_when_it_begins_anew) {
    Looker looker;
    looker.look(1);
    looker.foresight.begin({2});
    EXPECT_EQ(looker.look(0.5f), Looker(2).look(0.5f));
}

}  // namespace
}  // namespace surefoot
