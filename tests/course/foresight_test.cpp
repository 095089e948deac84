// What walkers foresee.

#include <surefoot/course/foresight.h>

#include <gtest/gtest.h>

namespace surefoot {
namespace {

/// Not linear in its steps, so that another way to the same moment shows.
struct Counter {
    float value = 1;

    friend bool operator==(const Counter&, const Counter&) = default;
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

TEST(Foresight, keeps_what_comes_as_it_was_foreseen) {
    constexpr float k_step = 1 / k_walk_fps;
    Looker looker;
    const float far = looker.look(60 * k_step), soon = looker.look(k_step);
    const std::uint64_t number = looker.foresight.number(60 * k_step);
    int gone = looker.gone;
    looker.foresight.go_on({soon});  // a step has passed
    EXPECT_EQ(looker.look(59 * k_step), far);
    EXPECT_EQ(looker.gone, gone + 1);  // the arrival
    EXPECT_EQ(looker.foresight.number(59 * k_step), number);
    looker.foresight.go_on({soon});  // nothing has happened
    EXPECT_EQ(looker.look(59 * k_step), far);
    EXPECT_EQ(looker.gone, gone + 2);
    for (int passed = 2; passed < 400; ++passed) {  // round and round
        looker.look(70 * k_step);
        gone = looker.gone;
        looker.foresight.go_on({looker.look(k_step)});
        EXPECT_EQ(looker.look(70 * k_step), Looker(looker.look(0)).look(70 * k_step));
        EXPECT_EQ(looker.gone, gone + 4);  // three arrivals and the one new step
    }
}

TEST(Foresight, forgets_when_something_else_happens) {
    Looker looker;
    looker.look(1);
    const std::uint64_t number = looker.foresight.number(0.5f);
    looker.foresight.go_on({2});
    EXPECT_EQ(looker.look(0.5f), Looker(2).look(0.5f));
    EXPECT_NE(looker.foresight.number(0.5f), number);
}

TEST(Foresight, moments_between_steps_have_no_number) {
    Looker looker;
    EXPECT_NE(looker.foresight.number(0), 0u);
    EXPECT_NE(looker.foresight.number(37.0f / 60), 0u);
    EXPECT_EQ(looker.foresight.number(0.5f / 60), 0u);
}

}  // namespace
}  // namespace surefoot
