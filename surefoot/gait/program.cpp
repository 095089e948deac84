#include <surefoot/gait/program.h>

namespace surefoot {

int gait_operands(GaitOp op) noexcept {
    switch (op) {
        case GaitOp::choose:
            return 3;
        case GaitOp::add:
        case GaitOp::subtract:
        case GaitOp::multiply:
        case GaitOp::divide:
        case GaitOp::less:
        case GaitOp::less_equal:
        case GaitOp::equal:
        case GaitOp::both:
        case GaitOp::either:
        case GaitOp::atan2:
        case GaitOp::min:
        case GaitOp::max:
        case GaitOp::mod:
            return 2;
        default:
            return 1;
    }
}

std::string GaitProgram::problem() const {
    if (registers < 0 || registers > k_max_gait_registers) return "it needs too many registers";
    if (instructions.size() > static_cast<std::size_t>(k_max_gait_instructions)) return "it has too many instructions";
    const std::size_t given = k_gait_inputs + static_cast<std::size_t>(parameters < 0 ? 0 : parameters);
    if (parameters < 0 || given + constants.size() > static_cast<std::size_t>(registers))
        return "its registers do not hold its parameters and constants";
    std::vector<bool> written(static_cast<std::size_t>(registers), false);
    for (std::size_t r = 0; r < given + constants.size(); ++r) written[r] = true;
    const auto readable = [&](std::uint16_t r) { return r < written.size() && written[r]; };
    for (const GaitInstruction& i : instructions) {
        if (static_cast<int>(i.op) >= k_gait_ops) return "it has an unknown instruction";
        const int count = gait_operands(i.op);
        if (!readable(i.a) || (count > 1 && !readable(i.b)) || (count > 2 && !readable(i.c)))
            return "it reads a register before writing it";
        if (i.to < given + constants.size() || i.to >= written.size()) return "it writes where it may not";
        written[i.to] = true;
    }
    for (const std::uint16_t r : outputs)
        if (!readable(r)) return "an output is never written";
    return {};
}

}  // namespace surefoot
