// The gait file of the paper as printed against its equations, written out here once more by hand in libm's double
// precision, and against numbers worked out by hand at times where sine and cosine are known.

#include <surefoot/gait_text/gait.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace surefoot {
namespace {

using Values = std::map<std::string, double>;

/// Equations (1) to (20), in their order of use; x holds the parameters.
Values printed(const Values& x, double time) {
    const auto p = [&](const char* name) { return x.at(name); };
    const double T = 24 * time;
    Values c;
    c["f_pelvis"] = std::sin(T * p("vM") * p("phi")) * p("wB");
    c["f_spine"] = std::sin(T * p("vM") * p("k")) * p("wC");
    c["ty"] = std::sin(T * p("vM")) + p("df");
    c["tz"] = std::cos(T * p("vM"));
    c["StY"] = p("Shgt") + c["tz"] * p("wB") - 0.85;
    c["StZ"] = c["tz"] * p("Sosc") - p("Spos") - c["f_spine"] - p("Hpos");
    c["CtZ"] = c["tz"] * p("wB") - p("Hpos");
    c["CtY"] = c["tz"] * p("Hosc") / 4 + c["f_pelvis"] + p("Hhgt") - 0.523;
    c["StY_ik"] = c["StY"] + 0.8;
    c["StZ_ik"] = c["StZ"] - 0.02;
    c["Ftau"] = std::sin(T * p("vM") - p("k")) / 20;
    c["RightFoot.tY"] = c["ty"] * p("FhgtR");
    c["RightFoot.tZ"] = -c["tz"] * p("SlgtR") + p("FposR");
    c["LeftFoot.tY"] = -c["ty"] * p("FhgtL");
    c["LeftFoot.tZ"] = -c["tz"] * p("SlgtL") + p("FposL");
    c["RightToe.tY"] = c["Ftau"];
    c["LeftToe.tY"] = -c["Ftau"];
    c["RightUpLeg.tZ"] = c["tz"] * p("Hosc") - p("Hpos");
    c["RightUpLeg.tY"] = p("Hhgt") + c["f_pelvis"] - c["ty"] * p("Hosc");
    c["LeftUpLeg.tZ"] = -c["tz"] * p("Hosc") - p("Hpos");
    c["LeftUpLeg.tY"] = p("Hhgt") + c["f_pelvis"] - c["ty"] * p("Hosc");
    c["AtauR"] = std::sin(time * 2 * p("AbncR"));
    c["AtauL"] = std::sin(time * 2 * p("AbncL"));
    c["RightArm.tY"] = p("AhgtR") - c["AtauR"] * p("AoscR");
    c["RightArm.tZ"] = -c["tz"] * p("wra") + p("AposR");
    c["LeftArm.tY"] = p("AhgtL") - c["AtauL"] * p("AoscL");
    c["LeftArm.tZ"] = c["tz"] * p("wla") + p("AposL");
    c["RightShoulder.tY"] = -c["ty"] * c["f_spine"];
    c["RightShoulder.tZ"] = c["tz"] * c["f_spine"];
    c["LeftShoulder.tY"] = c["ty"] * c["f_spine"];
    c["LeftShoulder.tZ"] = -c["tz"] * c["f_spine"];
    return c;
}

/// Every parameter different, so that a mix-up shows.
const Values k_distinct = {{"vM", 0.31},    {"phi", 1.7},     {"wB", 0.11},    {"k", 2.3},      {"wC", 0.13},
                           {"Hosc", 0.17},  {"Hhgt", 0.61},   {"Hpos", 0.19},  {"Sosc", 0.23},  {"Shgt", 0.807},
                           {"Spos", 0.29},  {"df", 0.37},     {"FhgtR", 0.41}, {"FhgtL", 0.43}, {"FposR", 0.47},
                           {"FposL", 0.53}, {"SlgtR", 0.59},  {"SlgtL", 0.67}, {"AbncR", 3.1},  {"AbncL", 3.7},
                           {"wra", 0.71},   {"wla", 0.73},    {"AhgtR", 0.79}, {"AhgtL", 0.83}, {"AposR", 0.89},
                           {"AposL", 0.97}, {"AoscR", 0.101}, {"AoscL", 0.103}};

Gait as_printed() {
    return read_gait(bundled_gait("bhatti2017_as_printed"), "bhatti2017_as_printed.gait", GaitOutputs::everything);
}

std::vector<double> ordered(const Gait& gait, const Values& x) {
    std::vector<double> values;
    for (const GaitParameter& p : gait.parameters) values.push_back(x.at(p.name));
    return values;
}

Values exactly(const Gait& gait, const Values& x, double time) {
    const double inputs[k_gait_inputs] = {time, 0, 0, 0, 0};
    std::vector<double> out(gait.program.outputs.size());
    run_exactly(gait.program, inputs, ordered(gait, x), out);
    Values controls;
    for (std::size_t o = 0; o < gait.outputs.size(); ++o) controls[gait.outputs[o].name] = out[o];
    return controls;
}

TEST(Bhatti2017AsPrinted, every_control_is_the_papers_over_a_period) {
    const Gait gait = as_printed();
    ASSERT_EQ(gait.parameters.size(), k_distinct.size());
    EXPECT_TRUE(gait.warnings.empty());
    const double period = 2 * 3.14159265358979323846 / 0.31 / 24;
    EXPECT_NEAR(gait_period(gait, ordered(gait, k_distinct), 0, 0, 0), period, 1e-12);
    for (int i = 0; i <= 100; ++i) {
        const double time = period * i / 100;
        const Values expected = printed(k_distinct, time), got = exactly(gait, k_distinct, time);
        ASSERT_EQ(got.size(), expected.size());
        for (const auto& [name, value] : expected) EXPECT_NEAR(got.at(name), value, 1e-12) << name << " at " << time;
    }
}

TEST(Bhatti2017AsPrinted, eight_lanes_are_within_a_millionth_of_the_paper) {
    const Gait gait = as_printed();
    std::vector<float> parameters;
    for (const double value : ordered(gait, k_distinct))
        parameters.insert(parameters.end(), 8, static_cast<float>(value));
    std::vector<float> out(8 * gait.program.outputs.size());
    double worst = 0;
    for (int i = 0; i < 104; i += 8) {
        float inputs[8 * k_gait_inputs] = {};
        for (int lane = 0; lane < 8; ++lane) inputs[lane] = 0.84f * static_cast<float>(i + lane) / 104;
        run(gait.program, inputs, parameters, out);
        for (int lane = 0; lane < 8; ++lane) {
            const Values expected = printed(k_distinct, static_cast<double>(inputs[lane]));
            for (std::size_t o = 0; o < gait.outputs.size(); ++o) {
                const double error = std::fabs(static_cast<double>(out[8 * o + static_cast<std::size_t>(lane)]) -
                                               expected.at(gait.outputs[o].name));
                EXPECT_LT(error, 1e-6) << gait.outputs[o].name << " at " << inputs[lane];
                worst = std::fmax(worst, error);
            }
        }
    }
    RecordProperty("worst_error_in_billionths", static_cast<int>(worst * 1e9));
}

// vM = pi / 12: a cycle is 24 frames, one second. phi = 1, k = 2, and sines are known.
TEST(Bhatti2017AsPrinted, numbers_worked_out_by_hand_come_out) {
    const Gait gait = as_printed();
    Values x = k_distinct;
    x["vM"] = 3.14159265358979323846 / 12;
    x["phi"] = 1;
    x["k"] = 2;
    // T = 6: sine 1, cosine 0; T = 2: sine 1/2, cosine sqrt(3)/2, sine of twice that sqrt(3)/2.
    const Values at6 = exactly(gait, x, 0.25), at2 = exactly(gait, x, 1.0 / 12), at0 = exactly(gait, x, 0);
    const auto near = [](const Values& c, const char* name, double value) {
        EXPECT_NEAR(c.at(name), value, 1e-8) << name;
    };
    near(at6, "f_pelvis", 0.11);
    near(at6, "f_spine", 0);
    near(at6, "ty", 1.37);
    near(at6, "tz", 0);
    near(at6, "StY", -0.043);  // 0.807 - 0.85
    near(at6, "StZ", -0.48);   // -0.29 - 0.19
    near(at6, "CtZ", -0.19);
    near(at6, "CtY", 0.197);  // 0.11 + 0.61 - 0.523
    near(at6, "StY_ik", 0.757);
    near(at6, "StZ_ik", -0.5);
    near(at6, "Ftau", -0.0208073418);   // sin(pi/2 - 2) / 20 = cos(2) / 20
    near(at6, "RightFoot.tY", 0.5617);  // 1.37 * 0.41
    near(at6, "RightFoot.tZ", 0.47);
    near(at6, "LeftFoot.tY", -0.5891);  // -1.37 * 0.43
    near(at6, "LeftFoot.tZ", 0.53);
    near(at6, "LeftToe.tY", 0.0208073418);
    near(at6, "RightUpLeg.tZ", -0.19);
    near(at6, "RightUpLeg.tY", 0.4871);  // 0.61 + 0.11 - 1.37 * 0.17
    near(at6, "LeftUpLeg.tY", 0.4871);
    near(at2, "f_spine", 0.1125833025);  // 0.13 * 0.8660254038
    near(at2, "ty", 0.87);
    near(at2, "tz", 0.8660254038);
    near(at2, "StY", 0.0522627944);                // 0.807 + 0.0952627944 - 0.85
    near(at2, "CtY", 0.1788060797);                // 0.0368060797 + 0.055 + 0.61 - 0.523
    near(at2, "RightFoot.tZ", -0.0409549882);      // -0.5109549882 + 0.47
    near(at2, "RightShoulder.tY", -0.0979474732);  // -0.87 * 0.1125833025
    near(at2, "LeftShoulder.tZ", -0.0975);         // -0.13 * 3 / 4
    near(at0, "AtauR", 0);
    near(at0, "RightArm.tY", 0.79);
    near(at0, "RightArm.tZ", 0.18);  // -0.71 + 0.89
    near(at0, "LeftArm.tZ", 1.7);    // 0.73 + 0.97
    near(at0, "RightUpLeg.tZ", -0.02);
    near(at0, "LeftUpLeg.tZ", -0.36);
}

}  // namespace
}  // namespace surefoot
