// The expressions of gait.h by precedence climbing; their names and functions.

#include <surefoot/gait_text/definitions.h>
#include <surefoot/math/trig.h>

#include <algorithm>
#include <array>

namespace surefoot {

namespace {

constexpr std::array<std::string_view, 3> k_word_operators = {"and", "or", "not"};
constexpr std::array<std::string_view, 7> k_common_words = {"parameter", "let",   "preset", "in",
                                                            "unit",      "group", "help"};

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

/// A function: one operation, or an expansion made by `expanded`.
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

/// A function that is made of others.
Node expanded(Formula& f, const Function& function, const std::vector<Node>& a) {
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

bool Definitions::is_word(std::string_view name) const {
    if (dialect_.moments && (find_named(k_inputs, name) != k_inputs.end() || name == "T")) return true;
    return holds(dialect_.statements, name) || holds(k_common_words, name) || holds(k_word_operators, name) ||
           find_named(k_functions, name) != k_functions.end() || name == "pi";
}

Node Definitions::checked(Node node, std::size_t at) const {
    if (formula.full())
        tokens.fail(
            "the " + std::string(dialect_.noun) + " has more than " + std::to_string(k_max_gait_nodes) + " operations",
            at, "make it of fewer or simpler expressions");
    return node;
}

Node Definitions::expression() {
    const Depth depth(depth_, tokens);
    return choice();
}

Node Definitions::choice() {
    const Node truth = binary(0);
    if (!tokens.accept("?")) return truth;
    const Node yes = expression();
    tokens.expect(":", "a choice is written c ? a : b");
    const Node no = expression();
    return formula.make(GaitOp::choose, truth, yes, no);
}

/// Levels from weakest: or, and, comparisons, + -, * /. `not` stands between `and` and comparisons.
Node Definitions::binary(int level) {
    if (level == 2 && tokens.accept("not")) {
        const Depth depth(depth_, tokens);
        return formula.make(GaitOp::invert, binary(2));
    }
    if (level == 5) return unary();
    Node left = binary(level + 1);
    for (;;) {
        const std::size_t at = tokens.peek().at;
        const auto right = [&] { return binary(level + 1); };
        if (level == 0 && tokens.accept("or"))
            left = formula.make(GaitOp::either, left, right());
        else if (level == 1 && tokens.accept("and"))
            left = formula.make(GaitOp::both, left, right());
        else if (level == 3 && tokens.accept("+"))
            left = formula.make(GaitOp::add, left, right());
        else if (level == 3 && tokens.accept("-"))
            left = formula.make(GaitOp::subtract, left, right());
        else if (level == 4 && tokens.accept("*"))
            left = formula.make(GaitOp::multiply, left, right());
        else if (level == 4 && tokens.accept("/"))
            left = formula.make(GaitOp::divide, left, right());
        else
            break;
        checked(left, at);
    }
    if (level != 2) return left;
    const std::string_view sign = tokens.peek().kind == TokenKind::sign ? tokens.peek().text : std::string_view{};
    Node compared = left;
    if (tokens.accept("<"))
        compared = formula.make(GaitOp::less, left, binary(3));
    else if (tokens.accept("<="))
        compared = formula.make(GaitOp::less_equal, left, binary(3));
    else if (tokens.accept(">")) {
        const Node right = binary(3);
        compared = formula.make(GaitOp::less, right, left);
    } else if (tokens.accept(">=")) {
        const Node right = binary(3);
        compared = formula.make(GaitOp::less_equal, right, left);
    } else if (tokens.accept("=="))
        compared = formula.make(GaitOp::equal, left, binary(3));
    else if (tokens.accept("!="))
        compared = formula.make(GaitOp::invert, formula.make(GaitOp::equal, left, binary(3)));
    else
        return left;
    const std::string_view next = tokens.peek().kind == TokenKind::sign ? tokens.peek().text : std::string_view{};
    if (next == "<" || next == "<=" || next == ">" || next == ">=" || next == "==" || next == "!=")
        tokens.fail("comparisons do not chain: " + std::string(sign) + " is followed by " + std::string(next),
                    tokens.peek().at, "write a < b and b < c");
    return compared;
}

Node Definitions::unary() {
    if (tokens.peek().kind == TokenKind::sign && (tokens.peek().text == "-" || tokens.peek().text == "+")) {
        const Depth depth(depth_, tokens);
        const bool minus = tokens.take().text == "-";
        const Node node = unary();
        return minus ? formula.make(GaitOp::negate, node) : node;
    }
    return primary();
}

Node Definitions::primary() {
    const Token token = tokens.peek();
    if (token.kind == TokenKind::number) {
        tokens.take();
        return checked(formula.constant(token.number), token.at);
    }
    if (tokens.accept("(")) {
        const Node node = expression();
        tokens.expect(")", "every ( needs its )");
        return node;
    }
    const auto begins_none = [&](std::string_view word) {
        return holds(dialect_.statements, word) || holds(k_common_words, word) || holds(k_word_operators, word);
    };
    if (token.kind == TokenKind::name && !begins_none(token.text)) {
        tokens.take();
        return checked(tokens.peek().text == "(" && tokens.peek().kind == TokenKind::sign ? call(token) : name(token),
                       token.at);
    }
    tokens.fail("a value is missing before " + quoted(token), token.at,
                "write a number, a name, a function or something in parentheses");
}

Node Definitions::name(const Token& token) {
    if (token.text == "pi") return formula.constant(k_pi);
    if (dialect_.moments && token.text == "T")
        return formula.make(GaitOp::multiply, formula.input(GaitInput::time),
                            formula.constant(k_gait_frames_per_second));
    if (const auto input = find_named(k_inputs, token.text); dialect_.moments && input != k_inputs.end())
        return formula.input(input->input);
    const auto found = symbols_.find(token.text);
    if (found == symbols_.end()) {
        const bool function = find_named(k_functions, token.text) != k_functions.end();
        tokens.fail(
            function ? "the arguments of " + quoted(token) + " are missing" : "nothing above is named " + quoted(token),
            token.at, function ? "write them in parentheses" : "define it above by parameter or let");
    }
    found->second.used = true;
    return found->second.node;
}

Node Definitions::call(const Token& token) {
    const auto function = find_named(k_functions, token.text);
    if (function == k_functions.end())
        tokens.fail(
            "there is no function " + quoted(token), token.at,
            "there are sin cos tan asin acos atan2 exp sqrt abs floor min max clamp mix smoothstep step mod pulse "
            "noise");
    tokens.expect("(", "write the arguments in parentheses");
    std::vector<Node> arguments;
    do {
        if (arguments.size() == k_any) tokens.fail("too many arguments", tokens.peek().at, "call it twice");
        arguments.push_back(expression());
    } while (tokens.accept(","));
    tokens.expect(")", "arguments are separated by commas and end with )");
    if (arguments.size() < function->least || arguments.size() > function->most)
        tokens.fail(std::string(token.text) + " takes " + std::to_string(function->least) +
                        (function->most > function->least ? " or more" : "") + " arguments, not " +
                        std::to_string(arguments.size()),
                    token.at, "see the list of functions in docs/gaits.md");
    if (function->expanded) return expanded(formula, *function, arguments);
    if (arguments.size() == 1) return formula.make(function->op, arguments[0]);
    Node node = arguments[0];
    for (std::size_t i = 1; i < arguments.size(); ++i) node = formula.make(function->op, node, arguments[i]);
    return node;
}

}  // namespace surefoot
