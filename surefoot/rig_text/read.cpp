// The statements of a template (rig_template.h).

#include <surefoot/base/error.h>
#include <surefoot/gait_text/definitions.h>
#include <surefoot/rig_text/rig_template.h>

#include <algorithm>
#include <array>

namespace surefoot {

namespace {

constexpr std::array<std::string_view, 12> k_statements = {"rig",   "from",    "set",  "scale", "joint", "chain",
                                                           "limit", "through", "role", "at",    "tip",   "when"};
constexpr Dialect k_dialect{"template", k_statements, false};
constexpr int k_max_bases = 8;  // deeper than anyone means, whatever the bundled templates say

std::string bundled_names() {
    std::string names;
    for (const char c : bundled_rig_names())
        if (c == '\n')
            names += ", ";
        else
            names += c;
    return names.substr(0, names.size() - 2);
}

class Reader {
  public:
    Reader(std::string_view text, const std::string& where) : definitions_(text, where, k_dialect) {}
    RigTemplate read();

  private:
    void statements();
    void statement();
    bool part_statement();
    void title();
    void base();
    void set();
    void let();
    void scale();
    void joint();
    void chain();
    void when();
    void limit();

    Token expect_name(const char* what);
    Token joint_name();
    Role role();
    Role role_of(const RigPart& part);
    void parent(RigPart& part);
    void add(RigPart part);
    int output(Node node);
    int point();
    int range();

    Definitions definitions_;
    Tokens& tokens_ = definitions_.tokens;
    RigTemplate rig_;
    std::vector<Node> nodes_{-1};  // the program's outputs; the first is the scale
    int when_ = -1, bases_ = 0;
    bool titled_ = false;
};

RigTemplate Reader::read() {
    if (tokens_.peek().text != "rig")
        tokens_.fail("a template begins by its name", tokens_.peek().at, "write: rig my_rig help \"...\"");
    statements();
    const std::size_t end = tokens_.peek().at;
    if (nodes_[0] < 0) tokens_.fail("the template has no scale", end, "write: scale = metres per unit");
    if (rig_.parts.empty()) tokens_.fail("the template has no joints", end, "write: joint Hips role hips at (0, 1, 0)");
    for (auto& [name, warning] : definitions_.unused()) rig_.warnings.push_back(std::move(warning));
    rig_.program = definitions_.compiled(nodes_);
    rig_.parameters = std::move(definitions_.parameters);
    rig_.presets = std::move(definitions_.presets);
    return std::move(rig_);
}

void Reader::statements() {
    while (tokens_.peek().kind != TokenKind::end) statement();
}

void Reader::statement() {
    const Token token = tokens_.peek();
    if (definitions_.statement() || part_statement()) return;
    if (tokens_.accept("rig")) return title();
    if (tokens_.accept("set")) return set();
    if (tokens_.accept("let")) return let();
    if (tokens_.accept("scale")) return scale();
    if (tokens_.accept("when")) return when();
    if (tokens_.accept("limit")) return limit();
    tokens_.fail("a statement cannot begin with " + quoted(token), token.at,
                 "statements begin with rig, parameter, set, let, scale, joint, chain, when, limit or preset");
}

/// What `when` may hold.
bool Reader::part_statement() {
    if (tokens_.accept("joint"))
        joint();
    else if (tokens_.accept("chain"))
        chain();
    else
        return false;
    return true;
}

void Reader::title() {
    if (titled_) tokens_.fail("the template is named twice", tokens_.peek().at, "leave one of the names");
    const Token name = expect_name("the template's name is missing");
    std::string help;
    if (tokens_.accept("from")) base();
    definitions_.notes({{"help", &help}});
    rig_.name = name.text;
    rig_.help = help;
    titled_ = true;
}

/// Reads the base's statements in place of `from BASE`.
void Reader::base() {
    const Token name = expect_name("the base's name is missing");
    const std::string_view text = bundled_rig(name.text);
    if (text.empty()) tokens_.fail("there is no template " + quoted(name), name.at, "there are " + bundled_names());
    if (++bases_ > k_max_bases) tokens_.fail("the bases never end", name.at, "a template cannot be its own base");
    const Tokens here = tokens_;
    tokens_ = Tokens(text, std::string(name.text) + ".rig");
    statements();
    tokens_ = here;
    titled_ = false;
}

void Reader::set() {
    const Token name = expect_name("the parameter's name is missing");
    GaitParameter* parameter = definitions_.find_parameter(name.text);
    if (parameter == nullptr)
        tokens_.fail("there is no parameter " + quoted(name) + " above", name.at,
                     "set gives a parameter of the base another default");
    tokens_.expect("=", "write: set parameter = value");
    const std::size_t at = tokens_.peek().at;
    const double value = definitions_.constant("the default");
    definitions_.check_range(*parameter, value, at);
    parameter->value = value;
}

void Reader::let() {
    const Token name = definitions_.new_name("let");
    tokens_.expect("=", "write: let name = expression");
    definitions_.define(name, definitions_.expression());
}

void Reader::scale() {
    if (nodes_[0] >= 0) tokens_.fail("the scale is given twice", tokens_.peek().at, "leave one of them");
    tokens_.expect("=", "write: scale = metres per unit");
    nodes_[0] = definitions_.expression();
}

void Reader::joint() {
    RigPart part;
    part.place = tokens_.place(tokens_.peek().at);
    part.names.emplace_back(joint_name().text);
    part.left = part.names[0].starts_with("Left");
    parent(part);
    if (tokens_.accept("role")) part.role = role_of(part);
    tokens_.expect("at", "write: joint Name in Parent at (x, y, z)");
    part.points.push_back(point());
    if (tokens_.accept("tip")) part.tip = point();
    add(std::move(part));
}

void Reader::chain() {
    RigPart part;
    part.place = tokens_.place(tokens_.peek().at);
    do part.names.emplace_back(joint_name().text);
    while (tokens_.peek().kind == TokenKind::name);
    part.left = part.names[0].starts_with("Left");
    tokens_.expect("=", "write: chain Spine = 3 in Hips through (x, y, z) (x, y, z)");
    part.count = output(definitions_.expression());
    parent(part);
    tokens_.expect("through", "write: chain Spine = 3 in Hips through (x, y, z) (x, y, z)");
    do part.points.push_back(point());
    while (tokens_.peek().text == "(");
    if (part.points.size() < 2)
        tokens_.fail("a chain leads from one point to another", tokens_.peek().at, "write two points or more");
    add(std::move(part));
}

void Reader::when() {
    if (when_ >= 0) tokens_.fail("a condition stands within another", tokens_.peek().at, "write: when a and b { }");
    when_ = output(definitions_.expression());
    tokens_.expect("{", "write: when condition { joint ... }");
    while (!tokens_.accept("}"))
        if (!part_statement())
            tokens_.fail("this cannot stand under a condition: " + quoted(tokens_.peek()), tokens_.peek().at,
                         "joints and chains can");
    when_ = -1;
}

void Reader::limit() {
    const Token token = tokens_.peek();
    const Role limited = role();
    if (role_name(limited).starts_with("right_"))
        tokens_.fail("limits are given for the left side", token.at, "the right side's are their mirror images");
    bool any = false;
    for (const char* axis : {"x", "y", "z"}) {
        if (!tokens_.accept(axis)) continue;
        const std::string place = tokens_.place(tokens_.peek().at);
        rig_.limits.push_back({limited, axis[0] - 'x', range(), place});
        any = true;
    }
    if (!any) tokens_.fail("the limit has no range", tokens_.peek().at, "write: limit left_lower_leg x [0, 150]");
}

// --- parts of statements

Token Reader::expect_name(const char* what) {
    const Token token = tokens_.peek();
    if (token.kind != TokenKind::name) tokens_.fail(what, token.at, "write a name before " + quoted(token));
    return tokens_.take();
}

/// Of a joint that is made: a name that no other has.
Token Reader::joint_name() {
    const Token token = expect_name("the joint's name is missing");
    const bool taken = std::any_of(rig_.parts.begin(), rig_.parts.end(), [&](const RigPart& part) {
        return std::find(part.names.begin(), part.names.end(), token.text) != part.names.end();
    });
    if (taken) tokens_.fail("there is a joint " + quoted(token) + " already", token.at, "choose another name");
    if (token.text.starts_with("Right"))
        tokens_.fail("the right side is not written", token.at, "what is named Left is mirrored");
    if (rig_.parts.size() >= static_cast<std::size_t>(k_max_gait_names))
        tokens_.fail("there are more than " + std::to_string(k_max_gait_names) + " joints", token.at, "use fewer");
    return token;
}

Role Reader::role() {
    const Token token = expect_name("the role is missing");
    const Role role = role_from_name(token.text);
    if (role == Role::count)
        tokens_.fail("there is no role " + quoted(token), token.at,
                     "roles are those of VRM in lower case, such as hips, left_upper_leg, left_index_proximal");
    return role;
}

void Reader::parent(RigPart& part) {
    if (!tokens_.accept("in")) {
        if (!rig_.parts.empty())
            tokens_.fail("this joint has no parent", tokens_.peek().at, "write: in Parent; only the first has none");
        return;
    }
    const Token token = expect_name("the parent's name is missing");
    const auto is_parent = [&](const RigPart& other) {
        if (other.count >= 0 && token.text == other.names[0] + ".end") return true;
        return other.count < 0 && other.names[0] == token.text;
    };
    const auto found = std::find_if(rig_.parts.begin(), rig_.parts.end(), is_parent);
    if (found == rig_.parts.end())
        tokens_.fail("there is no joint " + quoted(token) + " above", token.at,
                     "parents come first; the last joint of a chain is its first name with .end");
    if (found->left && !part.left)
        tokens_.fail("a joint of the left side carries one that is not", token.at, "begin its name with Left");
    part.parent = token.text;
}

/// A role that the part may have.
Role Reader::role_of(const RigPart& part) {
    const std::size_t at = tokens_.peek().at;
    const Role role = this->role();
    const std::string name(role_name(role));
    if (std::any_of(rig_.parts.begin(), rig_.parts.end(), [&](const RigPart& other) { return other.role == role; }))
        tokens_.fail("the role " + name + " is given twice", at, "each role has one joint");
    if (name.starts_with("right_") || name.starts_with("left_") != part.left)
        tokens_.fail("the role " + name + " is not of the side of " + part.names[0], at,
                     "joints named Left have roles of the left, all others one of the middle or none");
    return role;
}

void Reader::add(RigPart part) {
    part.when = when_;
    rig_.parts.push_back(std::move(part));
}

int Reader::output(Node node) {
    nodes_.push_back(node);
    return static_cast<int>(nodes_.size()) - 1;
}

int Reader::point() {
    tokens_.expect("(", "a point is written (x, y, z)");
    const int first = output(definitions_.expression());
    for (int i = 0; i < 2; ++i) {
        tokens_.expect(",", "a point is written (x, y, z)");
        output(definitions_.expression());
    }
    tokens_.expect(")", "a point is written (x, y, z)");
    return first;
}

int Reader::range() {
    tokens_.expect("[", "a range is written [low, high]");
    const int low = output(definitions_.expression());
    tokens_.expect(",", "a range is written [low, high]");
    output(definitions_.expression());
    tokens_.expect("]", "a range is written [low, high]");
    return low;
}

}  // namespace

RigTemplate read_rig_template(std::string_view text, const std::string& where) { return Reader(text, where).read(); }

std::vector<double> rig_values(const RigTemplate& rig, std::string_view preset,
                               std::span<const std::string> assignments) {
    return parameter_values(rig.name, rig.parameters, rig.presets, preset, assignments);
}

}  // namespace surefoot
