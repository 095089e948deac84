#pragma once
// Expressions as a graph in which equal parts are one, constants folded; and its way to a register program.

#include <surefoot/gait/program.h>

#include <map>
#include <span>
#include <tuple>
#include <vector>

namespace surefoot {

/// The number of a node.
using Node = int;

/// A graph of operations that grows only: operands stand before what uses them. No node is ever above the limit: see
/// `full`.
class Formula {
  public:
    Node constant(double value);
    Node input(GaitInput input);
    Node parameter(int index);
    Node make(GaitOp op, Node a, Node b, Node c);
    Node make(GaitOp op, Node a, Node b) { return make(op, a, b, a); }
    Node make(GaitOp op, Node a) { return make(op, a, a, a); }

    bool is_constant(Node node) const { return nodes_[index(node)].kind == Kind::constant; }
    /// [Needs: is_constant]
    double value(Node node) const { return nodes_[index(node)].value; }
    /// Time or phase is in it.
    bool uses_time(Node node) const { return nodes_[index(node)].timed; }
    bool full() const;

    /// The program that computes these nodes, of which some may be equal. Its `problem` tells where it breaks a limit.
    GaitProgram compile(int parameters, std::span<const Node> outputs) const;

  private:
    enum class Kind { constant, input, parameter, operation };
    struct Entry {
        Kind kind;
        double value = 0;  // of a constant
        int which = 0;     // input, parameter or operation
        Node operands[3] = {0, 0, 0};
        bool timed = false;
    };
    static std::size_t index(Node node) { return static_cast<std::size_t>(node); }
    Node add(const Entry& entry);

    std::vector<Entry> nodes_;
    std::map<std::tuple<Kind, std::uint64_t, int, Node, Node, Node>, Node> known_;
};

}  // namespace surefoot
