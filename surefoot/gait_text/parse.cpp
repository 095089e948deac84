// The statements of a gait (gait.h).

#include <surefoot/base/error.h>
#include <surefoot/gait_text/definitions.h>

#include <algorithm>
#include <array>

namespace surefoot {

namespace {

constexpr std::array<std::string_view, 3> k_statements = {"gait", "control", "period"};
constexpr Dialect k_dialect{"gait", k_statements, true};

class Parser {
  public:
    Parser(std::string_view text, const std::string& where) : definitions_(text, where, k_dialect) {}
    Gait read(GaitOutputs outputs);

  private:
    void statement();
    void title();
    void named(bool control);
    void period();
    bool is_control(std::string_view name) const;

    Definitions definitions_;
    Tokens& tokens_ = definitions_.tokens;
    Gait gait_;
    std::vector<Node> nodes_;  // of gait_.outputs
    Node period_ = -1;
    bool titled_ = false;
};

Gait Parser::read(GaitOutputs outputs) {
    while (tokens_.peek().kind != TokenKind::end) statement();
    const std::size_t end = tokens_.peek().at;
    if (std::none_of(gait_.outputs.begin(), gait_.outputs.end(), [](const auto& o) { return o.control; }))
        tokens_.fail("the gait has no control", end, "add one, such as: control hips.tY = 0.02 * sin(2 * pi * phase)");
    if (period_ < 0) period_ = definitions_.formula.constant(1.0);
    for (auto& [name, warning] : definitions_.unused())
        if (!is_control(name)) gait_.warnings.push_back(std::move(warning));

    std::vector<Node> wanted;
    std::vector<GaitOutput> kept;
    for (std::size_t o = 0; o < nodes_.size(); ++o) {
        if (outputs == GaitOutputs::controls && !gait_.outputs[o].control) continue;
        wanted.push_back(nodes_[o]);
        kept.push_back(gait_.outputs[o]);
    }
    gait_.outputs = std::move(kept);
    wanted.push_back(period_);
    gait_.program = definitions_.compiled(wanted);
    gait_.parameters = std::move(definitions_.parameters);
    gait_.presets = std::move(definitions_.presets);
    return std::move(gait_);
}

bool Parser::is_control(std::string_view name) const {
    return std::any_of(gait_.outputs.begin(), gait_.outputs.end(),
                       [&](const GaitOutput& output) { return output.control && output.name == name; });
}

void Parser::statement() {
    const Token token = tokens_.peek();
    if (definitions_.statement()) return;
    if (tokens_.accept("gait")) return title();
    if (tokens_.accept("let")) return named(false);
    if (tokens_.accept("control")) return named(true);
    if (tokens_.accept("period")) return period();
    tokens_.fail("a statement cannot begin with " + quoted(token), token.at,
                 "statements begin with gait, parameter, let, control, period or preset");
}

void Parser::title() {
    const Token token = tokens_.peek();
    if (titled_) tokens_.fail("the gait is named twice", token.at, "leave one of the names");
    if (token.kind != TokenKind::name) tokens_.fail("the gait's name is missing", token.at, "write: gait my_walk");
    gait_.name = tokens_.take().text;
    definitions_.notes({{"help", &gait_.help}});
    titled_ = true;
}

void Parser::named(bool control) {
    const Token token = definitions_.new_name(control ? "control" : "let");
    tokens_.expect("=", "write: let name = expression");
    const Node node = definitions_.expression();
    GaitOutput made{std::string(token.text), control, {}, {}};
    definitions_.notes({{"unit", &made.unit}, {"help", &made.help}});
    definitions_.define(token, node);
    gait_.outputs.push_back(std::move(made));
    nodes_.push_back(node);
}

void Parser::period() {
    const std::size_t at = tokens_.peek().at;
    if (period_ >= 0) tokens_.fail("the period is given twice", at, "leave one of them");
    tokens_.expect("=", "write: period = seconds");
    const std::size_t from = tokens_.peek().at;
    period_ = definitions_.expression();
    if (definitions_.formula.uses_time(period_))
        tokens_.fail("the period depends on time or phase", from, "make it of parameters, speed, turn and slope");
}

}  // namespace

Gait read_gait(std::string_view text, const std::string& where, GaitOutputs outputs) {
    return Parser(text, where).read(outputs);
}

}  // namespace surefoot
