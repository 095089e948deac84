#pragma once
// What gaits and rig templates (rig_text) have in common: parameters, presets, names and expressions. A reader of
// either takes words from `tokens`, lets `statement` take what is common, and reads the rest by the parts below.

#include <surefoot/gait_text/formula.h>
#include <surefoot/gait_text/gait.h>
#include <surefoot/gait_text/tokens.h>

#include <map>

namespace surefoot {

/// How one kind of text differs.
struct Dialect {
    std::string_view noun;                         ///< in messages: "gait"
    std::span<const std::string_view> statements;  ///< words that no name may be, beside those that all dialects share
    bool moments = false;  ///< t, phase, speed and their like mean something; else they are names like any other
};

class Definitions {
  public:
    /// Both texts must outlive this. Throws Error as Tokens does.
    Definitions(std::string_view text, const std::string& where, const Dialect& dialect);

    Tokens tokens;
    Formula formula;
    std::vector<GaitParameter> parameters;
    std::vector<GaitPreset> presets;

    /// Reads a `parameter` or a `preset`; false where the next word begins neither.
    bool statement();

    /// A name that is not taken yet.
    Token new_name(const char* what);
    void define(const Token& name, Node node);
    std::string text(const char* what);
    double constant(const char* what);
    Node expression();
    /// Words such as `unit "m"` in any order, until another word comes.
    struct Note {
        const char* word;
        std::string* text;
    };
    void notes(std::initializer_list<Note> notes);
    /// The parameter of that name, or nullptr.
    GaitParameter* find_parameter(std::string_view name);
    /// Throws where `value`, which stands at `at`, is outside the range of the parameter.
    void check_range(const GaitParameter& parameter, double value, std::size_t at) const;

    /// Names that no expression used, in the order of the text, as warnings with their places.
    struct Unused {
        std::string name, warning;
    };
    std::vector<Unused> unused() const;
    /// The program of these nodes; throws where it is too large.
    GaitProgram compiled(std::span<const Node> nodes) const;

  private:
    struct Symbol {
        Node node = 0;
        std::string place;
        bool used = false, parameter = false;
        std::size_t order = 0;
    };
    void parameter();
    void preset();
    bool is_word(std::string_view name) const;

    Node choice();
    Node binary(int level);
    Node comparison(Node left);
    Node unary();
    Node primary();
    Node name(const Token& token);
    Node call(const Token& token);
    Node checked(Node node, std::size_t at) const;

    Dialect dialect_;
    std::map<std::string, Symbol, std::less<>> symbols_;
    int depth_ = 0;
};

/// Values of parameters: the defaults, then the preset (empty: none), then `name=value` in order. `where` names their
/// text in messages. Throws Error for unknown names, what is no number, and values out of range.
std::vector<double> parameter_values(const std::string& where, std::span<const GaitParameter> parameters,
                                     std::span<const GaitPreset> presets, std::string_view preset,
                                     std::span<const std::string> assignments);

}  // namespace surefoot
