#include <surefoot/gait_text/formula.h>
#include <surefoot/gait_text/gait.h>

#include <cmath>
#include <cstring>

namespace surefoot {

Node Formula::add(const Entry& entry) {
    std::uint64_t bits;
    std::memcpy(&bits, &entry.value, sizeof bits);
    const auto [at, is_new] = known_.try_emplace(
        {entry.kind, bits, entry.which, entry.operands[0], entry.operands[1], entry.operands[2]}, Node(nodes_.size()));
    if (is_new) nodes_.push_back(entry);
    return at->second;
}

Node Formula::constant(double value) {
    // Outputs are cut there, too (gait/program.h).
    Entry entry{Kind::constant};
    entry.value = std::fabs(value) <= 1e30 ? value : 0.0;
    return add(entry);
}

Node Formula::input(GaitInput input) {
    Entry entry{Kind::input};
    entry.which = static_cast<int>(input);
    entry.timed = input == GaitInput::time || input == GaitInput::phase;
    return add(entry);
}

Node Formula::parameter(int index) {
    Entry entry{Kind::parameter};
    entry.which = index;
    return add(entry);
}

Node Formula::make(GaitOp op, Node a, Node b, Node c) {
    const int count = gait_operands(op);
    if (is_constant(a) && (count < 2 || is_constant(b)) && (count < 3 || is_constant(c)))
        return constant(apply(op, value(a), value(b), value(c)));
    if (op == GaitOp::choose && is_constant(a)) return value(a) != 0.0 ? b : c;
    Entry entry{Kind::operation};
    entry.which = static_cast<int>(op);
    const Node operands[3] = {a, count > 1 ? b : a, count > 2 ? c : a};
    for (int i = 0; i < 3; ++i) {
        entry.operands[i] = operands[i];
        entry.timed = entry.timed || uses_time(operands[i]);
    }
    return add(entry);
}

bool Formula::full() const { return nodes_.size() >= static_cast<std::size_t>(k_max_gait_nodes); }

GaitProgram Formula::compile(int parameters, std::span<const Node> outputs) const {
    // What is needed, and how long: the last node that reads each. An output is kept to the end.
    const int never = -1, forever = static_cast<int>(nodes_.size());
    std::vector<int> last_use(nodes_.size(), never);
    for (const Node output : outputs) last_use[index(output)] = forever;
    for (int n = forever - 1; n >= 0; --n) {
        if (last_use[index(n)] == never || nodes_[index(n)].kind != Kind::operation) continue;
        for (const Node operand : nodes_[index(n)].operands)
            if (last_use[index(operand)] < n) last_use[index(operand)] = n;
    }

    GaitProgram program;
    program.parameters = parameters;
    std::vector<int> place(nodes_.size(), 0);
    for (int n = 0; n < forever; ++n) {
        const Entry& entry = nodes_[index(n)];
        if (entry.kind == Kind::input) place[index(n)] = entry.which;
        if (entry.kind == Kind::parameter) place[index(n)] = k_gait_inputs + entry.which;
        if (entry.kind != Kind::constant || last_use[index(n)] == never) continue;
        place[index(n)] = k_gait_inputs + parameters + static_cast<int>(program.constants.size());
        program.constants.push_back(entry.value);
    }
    program.registers = k_gait_inputs + parameters + static_cast<int>(program.constants.size());

    // Registers of what was read for the last time are used again.
    std::vector<int> free;
    for (int n = 0; n < forever && program.registers <= k_max_gait_registers; ++n) {
        const Entry& entry = nodes_[index(n)];
        if (entry.kind != Kind::operation || last_use[index(n)] == never) continue;
        GaitInstruction instruction{static_cast<GaitOp>(entry.which)};
        std::uint16_t* from[3] = {&instruction.a, &instruction.b, &instruction.c};
        for (int i = 0; i < 3; ++i) *from[i] = static_cast<std::uint16_t>(place[index(entry.operands[i])]);
        for (int i = 0; i < 3; ++i) {
            const Node operand = entry.operands[i];
            const bool repeated = (i > 0 && operand == entry.operands[0]) || (i > 1 && operand == entry.operands[1]);
            if (!repeated && nodes_[index(operand)].kind == Kind::operation && last_use[index(operand)] == n)
                free.push_back(place[index(operand)]);
        }
        if (free.empty()) free.push_back(program.registers++);
        place[index(n)] = free.back();
        free.pop_back();
        instruction.to = static_cast<std::uint16_t>(place[index(n)]);
        program.instructions.push_back(instruction);
    }
    for (const Node output : outputs) program.outputs.push_back(static_cast<std::uint16_t>(place[index(output)]));
    return program;
}

}  // namespace surefoot
