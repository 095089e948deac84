// The grammar of gait.h by recursive descent, statements first, expressions by precedence.

#include "formula.h"
#include "tokens.h"

#include <surefoot/base/error.h>
#include <surefoot/gait_text/gait.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <array>
#include <map>

namespace surefoot {

namespace {

constexpr std::array<std::string_view, 10> k_statements = {"gait",   "parameter", "let",  "control", "period",
                                                           "preset", "in",        "unit", "group",   "help"};
constexpr std::array<std::string_view, 3> k_word_operators = {"and", "or", "not"};

struct Input {
    std::string_view name;
    GaitInput input;
};
constexpr std::array<Input, 6> k_inputs = {{{"t", GaitInput::time},
                                            {"time", GaitInput::time},
                                            {"phase", GaitInput::phase},
                                            {"speed", GaitInput::speed},
                                            {"turn", GaitInput::turn},
                                            {"slope", GaitInput::slope}}};

/// A function: one operation, or an expansion made by Parser::expand.
struct Function {
    std::string_view name;
    std::size_t least, most;  // arguments
    GaitOp op = GaitOp::add;
    bool expanded = false;
};
constexpr std::size_t k_any = 64;
constexpr std::array<Function, 19> k_functions = {{{"sin", 1, 1, GaitOp::sin},
                                                   {"cos", 1, 1, GaitOp::cos},
                                                   {"tan", 1, 1, GaitOp::tan},
                                                   {"asin", 1, 1, GaitOp::asin},
                                                   {"acos", 1, 1, GaitOp::acos},
                                                   {"atan2", 2, 2, GaitOp::atan2},
                                                   {"exp", 1, 1, GaitOp::exp},
                                                   {"sqrt", 1, 1, GaitOp::sqrt},
                                                   {"abs", 1, 1, GaitOp::abs},
                                                   {"floor", 1, 1, GaitOp::floor},
                                                   {"mod", 2, 2, GaitOp::mod},
                                                   {"noise", 1, 1, GaitOp::noise},
                                                   {"min", 2, k_any, GaitOp::min},
                                                   {"max", 2, k_any, GaitOp::max},
                                                   {"clamp", 3, 3, GaitOp::add, true},
                                                   {"mix", 3, 3, GaitOp::add, true},
                                                   {"smoothstep", 3, 3, GaitOp::add, true},
                                                   {"step", 2, 2, GaitOp::add, true},
                                                   {"pulse", 2, 2, GaitOp::add, true}}};

template <class List>
bool holds(const List& list, std::string_view text) {
    return std::find(list.begin(), list.end(), text) != list.end();
}
template <class List>
auto find_named(const List& list, std::string_view name) {
    return std::find_if(list.begin(), list.end(), [&](const auto& entry) { return entry.name == name; });
}

struct Symbol {
    Node node = 0;
    std::size_t at = 0;
    bool used = false;
    bool parameter = false;
};

class Parser {
  public:
    Parser(std::string_view text, const std::string& where) : tokens_(text, where) {}
    Gait read(GaitOutputs outputs);

  private:
    void statement();
    void title();
    void parameter();
    void named(bool control);
    void period();
    void preset();

    Token new_name(const char* what);
    std::string text(const char* what);
    double constant(const char* what);
    void define(const Token& name, Node node, bool parameter);

    Node expression();
    Node choice();
    Node binary(int level);
    Node unary();
    Node primary();
    Node name(const Token& token);
    Node call(const Token& token);
    Node expand(const Function& function, const std::vector<Node>& a);
    /// Throws where there are too many nodes: every token adds a few at most.
    Node checked(Node node, std::size_t at);
    GaitProgram compiled(std::vector<Node> nodes);

    Tokens tokens_;
    Formula formula_;
    Gait gait_;
    std::map<std::string, Symbol, std::less<>> symbols_;
    std::vector<Node> nodes_;  // of gait_.outputs
    Node period_ = -1;
    bool titled_ = false;
    int depth_ = 0;
};

// --- statements

Gait Parser::read(GaitOutputs outputs) {
    while (tokens_.peek().kind != TokenKind::end) statement();
    const std::size_t end = tokens_.peek().at;
    if (std::none_of(gait_.outputs.begin(), gait_.outputs.end(), [](const auto& o) { return o.control; }))
        tokens_.fail("the gait has no control", end, "add one, such as: control hips.tY = 0.02 * sin(2 * pi * phase)");
    if (period_ < 0) period_ = formula_.constant(1.0);

    std::vector<std::pair<std::size_t, std::string>> idle;
    for (const auto& [name, symbol] : symbols_)
        if (!symbol.used) {
            const auto output = find_named(gait_.outputs, name);
            if (output != gait_.outputs.end() && output->control) continue;
            idle.emplace_back(symbol.at, tokens_.place(symbol.at) + ": nothing uses " +
                                             (symbol.parameter ? "parameter '" : "'") + name + "'");
        }
    std::sort(idle.begin(), idle.end());
    for (auto& [at, warning] : idle) gait_.warnings.push_back(std::move(warning));

    std::vector<Node> wanted;
    std::vector<GaitOutput> kept;
    for (std::size_t o = 0; o < nodes_.size(); ++o) {
        if (outputs == GaitOutputs::controls && !gait_.outputs[o].control) continue;
        wanted.push_back(nodes_[o]);
        kept.push_back(gait_.outputs[o]);
    }
    gait_.outputs = std::move(kept);
    wanted.push_back(period_);
    gait_.program = compiled(std::move(wanted));
    return std::move(gait_);
}

GaitProgram Parser::compiled(std::vector<Node> nodes) {
    GaitProgram program = formula_.compile(static_cast<int>(gait_.parameters.size()), nodes);
    if (const std::string problem = program.problem(); !problem.empty())
        tokens_.fail("the gait is too large: " + problem, tokens_.peek().at, "make it of fewer or simpler expressions");
    return program;
}

void Parser::statement() {
    const Token token = tokens_.peek();
    if (tokens_.accept("gait")) return title();
    if (tokens_.accept("parameter")) return parameter();
    if (tokens_.accept("let")) return named(false);
    if (tokens_.accept("control")) return named(true);
    if (tokens_.accept("period")) return period();
    if (tokens_.accept("preset")) return preset();
    tokens_.fail("a statement cannot begin with " + quoted(token), token.at,
                 "statements begin with gait, parameter, let, control, period or preset");
}

void Parser::title() {
    const Token token = tokens_.peek();
    if (titled_) tokens_.fail("the gait is named twice", token.at, "leave one of the names");
    if (token.kind != TokenKind::name) tokens_.fail("the gait's name is missing", token.at, "write: gait my_walk");
    gait_.name = tokens_.take().text;
    if (tokens_.accept("help")) gait_.help = text("help");
    titled_ = true;
}

void Parser::parameter() {
    const Token token = new_name("parameter");
    GaitParameter made;
    made.name = token.text;
    tokens_.expect("=", "write: parameter name = default in [low, high]");
    const std::size_t at = tokens_.peek().at;
    made.value = constant("the default");
    if (tokens_.accept("in")) {
        tokens_.expect("[", "write the range as [low, high]");
        const std::size_t range_at = tokens_.peek().at;
        made.low = constant("the lower end");
        tokens_.expect(",", "write the range as [low, high]");
        made.high = constant("the upper end");
        tokens_.expect("]", "write the range as [low, high]");
        if (!(made.low <= made.high))
            tokens_.fail("the range of '" + made.name + "' ends before it begins", range_at, "put the lower end first");
        if (!(made.value >= made.low && made.value <= made.high))
            tokens_.fail("the default of '" + made.name + "' is outside its range", at,
                         "mend the default or the range");
    }
    for (;;) {
        if (tokens_.accept("unit"))
            made.unit = text("unit");
        else if (tokens_.accept("group"))
            made.group = text("group");
        else if (tokens_.accept("help"))
            made.help = text("help");
        else
            break;
    }
    define(token, formula_.parameter(static_cast<int>(gait_.parameters.size())), true);
    gait_.parameters.push_back(std::move(made));
}

void Parser::named(bool control) {
    const Token token = new_name(control ? "control" : "let");
    tokens_.expect("=", "write: let name = expression");
    const Node node = expression();
    GaitOutput made{std::string(token.text), control, {}, {}};
    for (;;) {
        if (tokens_.accept("unit"))
            made.unit = text("unit");
        else if (tokens_.accept("help"))
            made.help = text("help");
        else
            break;
    }
    define(token, node, false);
    gait_.outputs.push_back(std::move(made));
    nodes_.push_back(node);
}

void Parser::period() {
    const std::size_t at = tokens_.peek().at;
    if (period_ >= 0) tokens_.fail("the period is given twice", at, "leave one of them");
    tokens_.expect("=", "write: period = seconds");
    const std::size_t from = tokens_.peek().at;
    period_ = expression();
    if (formula_.uses_time(period_))
        tokens_.fail("the period depends on time or phase", from, "make it of parameters, speed, turn and slope");
}

void Parser::preset() {
    const Token token = tokens_.peek();
    if (token.kind != TokenKind::name) tokens_.fail("the preset's name is missing", token.at, "write: preset name { }");
    tokens_.take();
    GaitPreset made;
    made.name = token.text;
    if (find_named(gait_.presets, token.text) != gait_.presets.end())
        tokens_.fail("there is a preset " + quoted(token) + " already", token.at, "choose another name");
    if (tokens_.accept("help")) made.help = text("help");
    tokens_.expect("{", "write: preset name { parameter = value, ... }");
    while (!tokens_.accept("}")) {
        const Token parameter = tokens_.peek();
        const auto found = find_named(gait_.parameters, parameter.text);
        if (parameter.kind != TokenKind::name || found == gait_.parameters.end())
            tokens_.fail("there is no parameter " + quoted(parameter) + " above", parameter.at,
                         "presets set parameters, name = value");
        tokens_.take();
        tokens_.expect("=", "write: parameter = value");
        const std::size_t at = tokens_.peek().at;
        const double value = constant("the value");
        if (!(value >= found->low && value <= found->high))
            tokens_.fail("this is outside the range of " + quoted(parameter), at, "see the parameter's range");
        const int which = static_cast<int>(found - gait_.parameters.begin());
        for (const auto& earlier : made.values)
            if (earlier.parameter == which)
                tokens_.fail("the preset sets " + quoted(parameter) + " twice", parameter.at, "leave one of them");
        made.values.push_back({which, value});
        if (!tokens_.accept(",") && tokens_.peek().text != "}")
            tokens_.fail("a comma or } is missing before " + quoted(tokens_.peek()), tokens_.peek().at,
                         "write: preset name { parameter = value, ... }");
    }
    gait_.presets.push_back(std::move(made));
}

// --- parts of statements

Token Parser::new_name(const char* what) {
    const Token token = tokens_.peek();
    if (token.kind != TokenKind::name)
        tokens_.fail(std::string("the name of this ") + what + " is missing", token.at,
                     "write a name after " + std::string(what));
    const bool taken = holds(k_statements, token.text) || holds(k_word_operators, token.text) ||
                       find_named(k_inputs, token.text) != k_inputs.end() ||
                       find_named(k_functions, token.text) != k_functions.end() || token.text == "pi" ||
                       token.text == "T";
    if (taken) tokens_.fail(quoted(token) + " is a word of the language", token.at, "choose another name");
    const auto found = symbols_.find(token.text);
    if (found != symbols_.end())
        tokens_.fail(quoted(token) + " is defined already at " + tokens_.place(found->second.at), token.at,
                     "choose another name");
    if (symbols_.size() >= static_cast<std::size_t>(k_max_gait_names))
        tokens_.fail("there are more than " + std::to_string(k_max_gait_names) + " names", token.at, "use fewer");
    return tokens_.take();
}

std::string Parser::text(const char* what) {
    const Token token = tokens_.peek();
    if (token.kind != TokenKind::text)
        tokens_.fail("a text in quotes is missing before " + quoted(token), token.at,
                     std::string("write: ") + what + " \"...\"");
    return std::string(tokens_.take().text);
}

double Parser::constant(const char* what) {
    const std::size_t at = tokens_.peek().at;
    const Node node = expression();
    if (!formula_.is_constant(node))
        tokens_.fail(std::string(what) + " is not a constant", at, "use numbers and pi only");
    return formula_.value(node);
}

void Parser::define(const Token& name, Node node, bool parameter) {
    symbols_.emplace(std::string(name.text), Symbol{node, name.at, false, parameter});
}

// --- expressions

/// Counts how deep the parser stands in its own recursion.
class Depth {
  public:
    Depth(int& depth, const Tokens& tokens) : depth_(depth) {
        if (++depth_ <= k_max_gait_depth) return;
        --depth_;
        tokens.fail("this lies more than " + std::to_string(k_max_gait_depth) + " levels deep", tokens.peek().at,
                    "name a part of it by let");
    }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;
    ~Depth() { --depth_; }

  private:
    int& depth_;
};

Node Parser::checked(Node node, std::size_t at) {
    if (formula_.full())
        tokens_.fail("the gait has more than " + std::to_string(k_max_gait_nodes) + " operations", at,
                     "make it of fewer or simpler expressions");
    return node;
}

Node Parser::expression() {
    const Depth depth(depth_, tokens_);
    return choice();
}

Node Parser::choice() {
    const Node truth = binary(0);
    if (!tokens_.accept("?")) return truth;
    const Node yes = expression();
    tokens_.expect(":", "a choice is written c ? a : b");
    const Node no = expression();
    return formula_.make(GaitOp::choose, truth, yes, no);
}

/// Levels from weakest: or, and, comparisons, + -, * /. `not` stands between `and` and comparisons.
Node Parser::binary(int level) {
    if (level == 2 && tokens_.accept("not")) {
        const Depth depth(depth_, tokens_);
        return formula_.make(GaitOp::invert, binary(2));
    }
    if (level == 5) return unary();
    Node left = binary(level + 1);
    for (;;) {
        const std::size_t at = tokens_.peek().at;
        const auto right = [&] { return binary(level + 1); };
        if (level == 0 && tokens_.accept("or"))
            left = formula_.make(GaitOp::either, left, right());
        else if (level == 1 && tokens_.accept("and"))
            left = formula_.make(GaitOp::both, left, right());
        else if (level == 3 && tokens_.accept("+"))
            left = formula_.make(GaitOp::add, left, right());
        else if (level == 3 && tokens_.accept("-"))
            left = formula_.make(GaitOp::subtract, left, right());
        else if (level == 4 && tokens_.accept("*"))
            left = formula_.make(GaitOp::multiply, left, right());
        else if (level == 4 && tokens_.accept("/"))
            left = formula_.make(GaitOp::divide, left, right());
        else
            break;
        checked(left, at);
    }
    if (level != 2) return left;
    const std::string_view sign = tokens_.peek().kind == TokenKind::sign ? tokens_.peek().text : std::string_view{};
    Node compared = left;
    if (tokens_.accept("<"))
        compared = formula_.make(GaitOp::less, left, binary(3));
    else if (tokens_.accept("<="))
        compared = formula_.make(GaitOp::less_equal, left, binary(3));
    else if (tokens_.accept(">")) {
        const Node right = binary(3);
        compared = formula_.make(GaitOp::less, right, left);
    } else if (tokens_.accept(">=")) {
        const Node right = binary(3);
        compared = formula_.make(GaitOp::less_equal, right, left);
    } else if (tokens_.accept("=="))
        compared = formula_.make(GaitOp::equal, left, binary(3));
    else if (tokens_.accept("!="))
        compared = formula_.make(GaitOp::invert, formula_.make(GaitOp::equal, left, binary(3)));
    else
        return left;
    const std::string_view next = tokens_.peek().kind == TokenKind::sign ? tokens_.peek().text : std::string_view{};
    if (next == "<" || next == "<=" || next == ">" || next == ">=" || next == "==" || next == "!=")
        tokens_.fail("comparisons do not chain: " + std::string(sign) + " is followed by " + std::string(next),
                     tokens_.peek().at, "write a < b and b < c");
    return compared;
}

Node Parser::unary() {
    if (tokens_.peek().kind == TokenKind::sign && (tokens_.peek().text == "-" || tokens_.peek().text == "+")) {
        const Depth depth(depth_, tokens_);
        const bool minus = tokens_.take().text == "-";
        const Node node = unary();
        return minus ? formula_.make(GaitOp::negate, node) : node;
    }
    return primary();
}

Node Parser::primary() {
    const Token token = tokens_.peek();
    if (token.kind == TokenKind::number) {
        tokens_.take();
        return checked(formula_.constant(token.number), token.at);
    }
    if (tokens_.accept("(")) {
        const Node node = expression();
        tokens_.expect(")", "every ( needs its )");
        return node;
    }
    if (token.kind == TokenKind::name && !holds(k_statements, token.text) && !holds(k_word_operators, token.text)) {
        tokens_.take();
        return checked(tokens_.peek().text == "(" && tokens_.peek().kind == TokenKind::sign ? call(token) : name(token),
                       token.at);
    }
    tokens_.fail("a value is missing before " + quoted(token), token.at,
                 "write a number, a name, a function or something in parentheses");
}

Node Parser::name(const Token& token) {
    if (token.text == "pi") return formula_.constant(k_pi);
    if (token.text == "T")
        return formula_.make(GaitOp::multiply, formula_.input(GaitInput::time),
                             formula_.constant(k_gait_frames_per_second));
    if (const auto input = find_named(k_inputs, token.text); input != k_inputs.end())
        return formula_.input(input->input);
    const auto found = symbols_.find(token.text);
    if (found == symbols_.end()) {
        const bool function = find_named(k_functions, token.text) != k_functions.end();
        tokens_.fail(
            function ? "the arguments of " + quoted(token) + " are missing" : "nothing above is named " + quoted(token),
            token.at, function ? "write them in parentheses" : "define it above by parameter, let or control");
    }
    found->second.used = true;
    return found->second.node;
}

Node Parser::call(const Token& token) {
    const auto function = find_named(k_functions, token.text);
    if (function == k_functions.end())
        tokens_.fail(
            "there is no function " + quoted(token), token.at,
            "there are sin cos tan asin acos atan2 exp sqrt abs floor min max clamp mix smoothstep step mod pulse "
            "noise");
    tokens_.expect("(", "write the arguments in parentheses");
    std::vector<Node> arguments;
    do {
        if (arguments.size() == k_any) tokens_.fail("too many arguments", tokens_.peek().at, "call it twice");
        arguments.push_back(expression());
    } while (tokens_.accept(","));
    tokens_.expect(")", "arguments are separated by commas and end with )");
    if (arguments.size() < function->least || arguments.size() > function->most)
        tokens_.fail(std::string(token.text) + " takes " + std::to_string(function->least) +
                         (function->most > function->least ? " or more" : "") + " arguments, not " +
                         std::to_string(arguments.size()),
                     token.at, "see the list of functions in docs/gaits.md");
    if (function->expanded) return expand(*function, arguments);
    if (arguments.size() == 1) return formula_.make(function->op, arguments[0]);
    Node node = arguments[0];
    for (std::size_t i = 1; i < arguments.size(); ++i) node = formula_.make(function->op, node, arguments[i]);
    return node;
}

Node Parser::expand(const Function& function, const std::vector<Node>& a) {
    Formula& f = formula_;
    const Node zero = f.constant(0.0), one = f.constant(1.0);
    const auto clamped = [&](Node x, Node low, Node high) {
        return f.make(GaitOp::min, f.make(GaitOp::max, x, low), high);
    };
    if (function.name == "clamp") return clamped(a[0], a[1], a[2]);
    if (function.name == "mix")
        return f.make(GaitOp::add, a[0], f.make(GaitOp::multiply, f.make(GaitOp::subtract, a[1], a[0]), a[2]));
    if (function.name == "step") return f.make(GaitOp::less_equal, a[0], a[1]);
    if (function.name == "pulse") return f.make(GaitOp::less, f.make(GaitOp::mod, a[0], one), a[1]);
    // smoothstep: u u (3 - 2 u). Where both ends are one, it is a step there.
    const Node width = f.make(GaitOp::subtract, a[1], a[0]);
    const Node along = f.make(GaitOp::divide, f.make(GaitOp::subtract, a[2], a[0]), width);
    const Node u = f.make(GaitOp::choose, width, clamped(along, zero, one), f.make(GaitOp::less_equal, a[0], a[2]));
    const Node rest = f.make(GaitOp::subtract, f.constant(3.0), f.make(GaitOp::multiply, f.constant(2.0), u));
    return f.make(GaitOp::multiply, f.make(GaitOp::multiply, u, u), rest);
}

}  // namespace

Gait read_gait(std::string_view text, const std::string& where, GaitOutputs outputs) {
    return Parser(text, where).read(outputs);
}

}  // namespace surefoot
