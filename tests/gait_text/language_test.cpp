#include <surefoot/base/error.h>
#include <surefoot/gait_text/gait.h>

#include <gtest/gtest.h>

#include <cmath>

namespace surefoot {
namespace {

struct Moment {
    double time = 0, phase = 0, speed = 0, turn = 0, slope = 0;
};

double value(const std::string& expression, Moment m = {}) {
    const Gait gait = read_gait("control c = " + expression, "test.gait");
    const double inputs[k_gait_inputs] = {m.time, m.phase, m.speed, m.turn, m.slope};
    double out[2];
    run_exactly(gait.program, inputs, {}, out);
    return out[0];
}

std::string message(const std::string& text) {
    try {
        read_gait(text, "test.gait");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

#define EXPECT_SAYS(text, part) EXPECT_NE(message(text).find(part), std::string::npos) << message(text)

TEST(GaitLanguage, operators_bind_as_the_header_says) {
    EXPECT_EQ(value("1 + 2 * 3"), 7);
    EXPECT_EQ(value("(1 + 2) * 3"), 9);
    EXPECT_EQ(value("8 / 4 / 2"), 1);
    EXPECT_EQ(value("8 - 4 - 2"), 2);
    EXPECT_EQ(value("-2 * -3"), 6);
    EXPECT_EQ(value("- - 2"), 2);
    EXPECT_EQ(value("1 < 2 and 2 < 1 or 1 == 1"), 1);
    EXPECT_EQ(value("not 1 < 2"), 0);
    EXPECT_EQ(value("not 0 and 0"), 0);
    EXPECT_EQ(value("1 >= 1 ? 5 : 6"), 5);
    EXPECT_EQ(value("1 > 1 ? 5 : 2 <= 1 ? 6 : 7"), 7);
    EXPECT_EQ(value("1 != 1"), 0);
}

TEST(GaitLanguage, functions_give_what_their_names_say) {
    const Moment m{2.0, 0.25, 1.5, 30, -5};
    EXPECT_NEAR(value("sin(t) + cos(time) + tan(t)", m), std::sin(2.0) + std::cos(2.0) + std::tan(2.0), 1e-12);
    EXPECT_NEAR(value("asin(phase) + acos(phase) + atan2(t, -phase)", m),
                std::asin(0.25) + std::acos(0.25) + std::atan2(2.0, -0.25), 1e-12);
    EXPECT_NEAR(value("exp(phase) + sqrt(speed) + abs(slope) + floor(-speed)", m),
                std::exp(0.25) + std::sqrt(1.5) + 5 - 2, 1e-12);
    EXPECT_EQ(value("T", m), 48);
    EXPECT_EQ(value("turn + speed", m), 31.5);
    EXPECT_EQ(value("min(3, t, 4) + max(t, -1)", m), 4);
    EXPECT_EQ(value("clamp(t, 0, 1) + clamp(-t, 0, 1)", m), 1);
    EXPECT_EQ(value("mix(10, 20, phase)", m), 12.5);
    EXPECT_EQ(value("smoothstep(0, 1, phase)", m), 0.15625);
    EXPECT_EQ(value("smoothstep(0, 1, t) + smoothstep(3, 4, t)", m), 1);
    EXPECT_EQ(value("smoothstep(t, t, t) + smoothstep(3, 3, t)", m), 1);
    EXPECT_EQ(value("step(2, t) + step(2.1, t)", m), 1);
    EXPECT_EQ(value("mod(t, 1.5)", m), 0.5);
    EXPECT_EQ(value("pulse(phase, 0.3) + pulse(phase + 7.2, 0.3)", m), 1);
    EXPECT_EQ(value("noise(t)", m), 0);
    EXPECT_NEAR(value("pi"), 3.14159265358979, 1e-14);
}

TEST(GaitLanguage, constants_are_folded_and_equal_parts_computed_once) {
    EXPECT_EQ(read_gait("control c = sin(1) * 2 + mix(1, 2, 0.5)", "g").program.instructions.size(), 0u);
    const Gait gait = read_gait("let a = sin(t * 2)\ncontrol c = a + sin(t * 2)\ncontrol d = sin(t * 2)", "g");
    EXPECT_EQ(gait.program.instructions.size(), 3u);
}

TEST(GaitLanguage, registers_are_used_again) {
    std::string sum = "t";
    for (int i = 0; i < 2000; ++i) sum = "sin(" + sum.substr(0, 0) + "t * " + std::to_string(i) + ") + " + sum;
    std::string text = "control c = 0";
    for (int i = 0; i < 300; ++i) text += " + sin(cos(t * 2) + sin(t) * 3)";
    const Gait gait = read_gait(text, "g");
    EXPECT_LT(gait.program.registers, 20);
    EXPECT_SAYS("control c = " + sum, "too large: it needs too many registers");
}

TEST(GaitLanguage, a_text_says_everything_about_its_parameters_controls_and_presets) {
    const Gait gait = read_gait(R"(# a nod
gait nod help "Yes"
parameter rate = 1 in [-1, 2 * 2] unit "Hz" group "Time" help "Nods a second"
parameter free = -3
let swing = sin(2 * pi * rate * t) + free
control head.tY = swing unit "m" help "Up"
control twice = head.tY * 2
period = 1 / rate
preset quick help "Hurry" { rate = 3, free = -1 }
preset empty { }
)",
                                "nod.gait", GaitOutputs::everything);
    EXPECT_EQ(gait.name, "nod");
    EXPECT_EQ(gait.help, "Yes");
    ASSERT_EQ(gait.parameters.size(), 2u);
    EXPECT_EQ(gait.parameters[0].name, "rate");
    EXPECT_EQ(gait.parameters[0].low, -1);
    EXPECT_EQ(gait.parameters[0].high, 4);
    EXPECT_EQ(gait.parameters[0].unit, "Hz");
    EXPECT_EQ(gait.parameters[0].group, "Time");
    EXPECT_EQ(gait.parameters[0].help, "Nods a second");
    EXPECT_EQ(gait.parameters[1].value, -3);
    ASSERT_EQ(gait.outputs.size(), 3u);
    EXPECT_FALSE(gait.outputs[0].control);
    EXPECT_EQ(gait.outputs[1].name, "head.tY");
    EXPECT_EQ(gait.outputs[1].unit, "m");
    ASSERT_EQ(gait.presets.size(), 2u);
    EXPECT_TRUE(gait.warnings.empty());
    const std::string set[] = {"rate=2"};
    const auto values = gait_values(gait, "quick", set);
    EXPECT_EQ(values, (std::vector<double>{2, -1}));
    EXPECT_EQ(gait_period(gait, values, 0, 0, 0), 0.5);
    const std::string zero[] = {"rate=0"};
    EXPECT_THROW(gait_period(gait, gait_values(gait, "", zero), 0, 0, 0), Error);
}

TEST(GaitLanguage, parameters_cannot_be_set_to_nonsense) {
    const Gait gait = read_gait("gait g parameter a = 1 in [0, 2] control c = a", "g");
    for (const std::string bad : {"b=1", "a", "a=", "a=x", "a=1x", "a=3", "a=-1", "a=nan", "a=inf", "=1"}) {
        const std::string set[] = {bad};
        EXPECT_THROW(gait_values(gait, "", set), Error) << bad;
    }
    EXPECT_THROW(gait_values(gait, "none", {}), Error);
}

TEST(GaitLanguage, names_that_nothing_uses_are_warned_of) {
    const Gait gait = read_gait("parameter a = 1\nlet b = 2\ncontrol c = 3\n", "g.gait");
    ASSERT_EQ(gait.warnings.size(), 2u);
    EXPECT_EQ(gait.warnings[0], "g.gait:1:11: nothing uses parameter 'a'");
    EXPECT_EQ(gait.warnings[1], "g.gait:2:5: nothing uses 'b'");
}

TEST(GaitLanguage, errors_show_line_column_and_a_caret) {
    EXPECT_EQ(message("gait x\ncontrol c = sin(t) +\tbad * 2\n"),
              "test.gait:2:22: nothing above is named 'bad'; define it above by parameter or let\n"
              "    control c = sin(t) +\tbad * 2\n"
              "                        \t^");
    EXPECT_EQ(
        message("control c = sin(t\n\n"),
        "test.gait:1:18: ')' is missing before the end of the text; arguments are separated by commas and end with )\n"
        "    control c = sin(t\n"
        "                     ^");
    // Columns are characters, not bytes.
    EXPECT_SAYS("gait x help \"\xc3\xa4\xc3\xb6\" oops", "test.gait:1:18: a statement cannot begin with 'oops'");
    const std::string far(5000, ' ');
    EXPECT_LT(message("control c = 1" + far + "oops" + far).size(), 500u);
}

TEST(GaitLanguage, what_is_wrong_is_said) {
    EXPECT_SAYS("", "no control");
    EXPECT_SAYS("control c = ", "a value is missing before the end of the text");
    EXPECT_SAYS("control c = a let a = 1", "nothing above is named 'a'");
    EXPECT_SAYS("control c = c", "nothing above is named 'c'");
    EXPECT_SAYS("control a = 1 let a = 2", "'a' is defined already at test.gait:1:9");
    EXPECT_SAYS("parameter a = 1 parameter a = 2", "defined already");
    EXPECT_SAYS("let sin = 1", "a word of the language");
    EXPECT_SAYS("let T = 1", "a word of the language");
    EXPECT_SAYS("let preset = 1", "a word of the language");
    EXPECT_SAYS("parameter a = 3 in [0, 2]", "outside its range");
    EXPECT_SAYS("parameter a = 3 in [4, 2]", "ends before it begins");
    EXPECT_SAYS("parameter a = t", "not a constant");
    EXPECT_SAYS("parameter a = 1 preset p { b = 1 }", "there is no parameter 'b'");
    EXPECT_SAYS("parameter a = 1 in [0, 1] preset p { a = 2 }", "outside the range");
    EXPECT_SAYS("parameter a = 1 preset p { a = 1, a = 1 }", "twice");
    EXPECT_SAYS("preset p { } preset p { }", "already");
    EXPECT_SAYS("control c = foo(1)", "no function 'foo'");
    EXPECT_SAYS("control c = sin", "arguments of 'sin' are missing");
    EXPECT_SAYS("control c = sin(1, 2)", "sin takes 1 arguments, not 2");
    EXPECT_SAYS("control c = (1", "')' is missing");
    EXPECT_SAYS("control c = 1 ^ 2", "write x * x");
    EXPECT_SAYS("control c = 1 $ 2", "no use for this character");
    EXPECT_SAYS("control c = 2pi", "runs into");
    EXPECT_SAYS("control c = 1e99", "out of range");
    EXPECT_SAYS("control c = 1 < 2 < 3", "do not chain");
    EXPECT_SAYS("control c = 1 ? 2", "':' is missing");
    EXPECT_SAYS("control c = 1 unit m", "a text in quotes is missing");
    EXPECT_SAYS("gait g help \"open\ncontrol c = 1", "no closing quote");
    EXPECT_SAYS("period = t", "depends on time");
    EXPECT_SAYS("period = 1 period = 2", "given twice");
    EXPECT_SAYS("gait a gait b", "named twice");
}

TEST(GaitLanguage, texts_are_bounded_in_every_way) {
    const std::string many(100000, '(');
    EXPECT_SAYS("control c = " + many, "levels deep");
    EXPECT_SAYS("control c = " + std::string(100000, '-') + "1", "levels deep");
    std::string nots, calls, choices = "1";
    for (int i = 0; i < 20000; ++i) {
        nots += "not ";
        calls += "sin(";
        choices += " ? 1 : 1";
    }
    EXPECT_SAYS("control c = " + nots + "1", "levels deep");
    EXPECT_SAYS("control c = " + calls, "levels deep");
    EXPECT_SAYS("control c = " + choices, "levels deep");
    std::string names, sums = "control c = t";
    for (int i = 0; i < 1000; ++i) names += "let a" + std::to_string(i) + " = 1\n";
    EXPECT_SAYS(names, "more than 512 names");
    for (int i = 0; i < 20000; ++i) sums += " + " + std::to_string(i);
    EXPECT_SAYS(sums, "more than 16384 operations");
    EXPECT_SAYS("control c = 1 #" + std::string(k_max_gait_bytes, 'x'), "longer than");
    EXPECT_SAYS("control " + std::string(65, 'n') + " = 1", "longer than 64");
}

}  // namespace
}  // namespace surefoot
