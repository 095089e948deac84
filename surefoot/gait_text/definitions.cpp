#include <surefoot/base/error.h>
#include <surefoot/gait_text/definitions.h>

#include <algorithm>

namespace surefoot {

Definitions::Definitions(std::string_view text, const std::string& where, const Dialect& dialect)
    : tokens(text, where), dialect_(dialect) {}

bool Definitions::statement() {
    if (tokens.accept("parameter"))
        parameter();
    else if (tokens.accept("preset"))
        preset();
    else
        return false;
    return true;
}

void Definitions::parameter() {
    const Token token = new_name("parameter");
    GaitParameter made;
    made.name = token.text;
    tokens.expect("=", "write: parameter name = default in [low, high]");
    const std::size_t at = tokens.peek().at;
    made.value = constant("the default");
    if (tokens.accept("in")) {
        tokens.expect("[", "write the range as [low, high]");
        const std::size_t range_at = tokens.peek().at;
        made.low = constant("the lower end");
        tokens.expect(",", "write the range as [low, high]");
        made.high = constant("the upper end");
        tokens.expect("]", "write the range as [low, high]");
        if (!(made.low <= made.high))
            tokens.fail("the range of '" + made.name + "' ends before it begins", range_at, "put the lower end first");
        if (!(made.value >= made.low && made.value <= made.high))
            tokens.fail("the default of '" + made.name + "' is outside its range", at, "mend the default or the range");
    }
    notes({{"unit", &made.unit}, {"group", &made.group}, {"help", &made.help}});
    define(token, formula.parameter(static_cast<int>(parameters.size())));
    symbols_.find(token.text)->second.parameter = true;
    parameters.push_back(std::move(made));
}

void Definitions::preset() {
    const Token token = tokens.peek();
    if (token.kind != TokenKind::name) tokens.fail("the preset's name is missing", token.at, "write: preset name { }");
    tokens.take();
    GaitPreset made;
    made.name = token.text;
    if (std::any_of(presets.begin(), presets.end(), [&](const GaitPreset& p) { return p.name == token.text; }))
        tokens.fail("there is a preset " + quoted(token) + " already", token.at, "choose another name");
    notes({{"help", &made.help}});
    tokens.expect("{", "write: preset name { parameter = value, ... }");
    while (!tokens.accept("}")) {
        const Token name = tokens.peek();
        const GaitParameter* found = name.kind == TokenKind::name ? find_parameter(name.text) : nullptr;
        if (found == nullptr)
            tokens.fail("there is no parameter " + quoted(name) + " above", name.at,
                        "presets set parameters, name = value");
        tokens.take();
        tokens.expect("=", "write: parameter = value");
        const std::size_t at = tokens.peek().at;
        const double value = constant("the value");
        check_range(*found, value, at);
        const int which = static_cast<int>(found - parameters.data());
        for (const auto& earlier : made.values)
            if (earlier.parameter == which)
                tokens.fail("the preset sets " + quoted(name) + " twice", name.at, "leave one of them");
        made.values.push_back({which, value});
        if (!tokens.accept(",") && tokens.peek().text != "}")
            tokens.fail("a comma or } is missing before " + quoted(tokens.peek()), tokens.peek().at,
                        "write: preset name { parameter = value, ... }");
    }
    presets.push_back(std::move(made));
}

GaitParameter* Definitions::find_parameter(std::string_view name) {
    const auto found =
        std::find_if(parameters.begin(), parameters.end(), [&](const GaitParameter& p) { return p.name == name; });
    return found == parameters.end() ? nullptr : &*found;
}

void Definitions::check_range(const GaitParameter& parameter, double value, std::size_t at) const {
    if (!(value >= parameter.low && value <= parameter.high))
        tokens.fail("this is outside the range of '" + parameter.name + "'", at, "see the parameter's range");
}

void Definitions::notes(std::initializer_list<Note> notes) {
    const auto any = [&] {
        for (const Note& note : notes)
            if (tokens.accept(note.word)) {
                *note.text = text(note.word);
                return true;
            }
        return false;
    };
    while (any()) continue;
}

Token Definitions::new_name(const char* what) {
    const Token token = tokens.peek();
    if (token.kind != TokenKind::name)
        tokens.fail(std::string("the name of this ") + what + " is missing", token.at,
                    "write a name after " + std::string(what));
    if (is_word(token.text)) tokens.fail(quoted(token) + " is a word of the language", token.at, "choose another name");
    const auto found = symbols_.find(token.text);
    if (found != symbols_.end())
        tokens.fail(quoted(token) + " is defined already at " + found->second.place, token.at, "choose another name");
    if (symbols_.size() >= static_cast<std::size_t>(k_max_gait_names))
        tokens.fail("there are more than " + std::to_string(k_max_gait_names) + " names", token.at, "use fewer");
    return tokens.take();
}

void Definitions::define(const Token& name, Node node) {
    symbols_.emplace(std::string(name.text), Symbol{node, tokens.place(name.at), false, false, symbols_.size()});
}

std::string Definitions::text(const char* what) {
    const Token token = tokens.peek();
    if (token.kind != TokenKind::text)
        tokens.fail("a text in quotes is missing before " + quoted(token), token.at,
                    std::string("write: ") + what + " \"...\"");
    return std::string(tokens.take().text);
}

double Definitions::constant(const char* what) {
    const std::size_t at = tokens.peek().at;
    const Node node = expression();
    if (!formula.is_constant(node))
        tokens.fail(std::string(what) + " is not a constant", at, "use numbers and pi only");
    return formula.value(node);
}

std::vector<Definitions::Unused> Definitions::unused() const {
    std::vector<const decltype(symbols_)::value_type*> idle;
    for (const auto& entry : symbols_)
        if (!entry.second.used) idle.push_back(&entry);
    std::sort(idle.begin(), idle.end(), [](const auto* a, const auto* b) { return a->second.order < b->second.order; });
    std::vector<Unused> result;
    for (const auto* entry : idle) {
        const Symbol& symbol = entry->second;
        result.push_back({entry->first, symbol.place + ": nothing uses " + (symbol.parameter ? "parameter '" : "'") +
                                            entry->first + "'"});
    }
    return result;
}

GaitProgram Definitions::compiled(std::span<const Node> nodes) const {
    GaitProgram program = formula.compile(static_cast<int>(parameters.size()), nodes);
    if (const std::string problem = program.problem(); !problem.empty())
        tokens.fail("the " + std::string(dialect_.noun) + " is too large: " + problem, tokens.peek().at,
                    "make it of fewer or simpler expressions");
    return program;
}

}  // namespace surefoot
