#pragma once
// The words that graph files have for enumerations. Private to graph_text/.

#include <surefoot/program/program.h>

#include <array>
#include <string_view>
#include <utility>

namespace surefoot {

template <class Value, std::size_t Count>
using Words = std::array<std::pair<std::string_view, Value>, Count>;

inline constexpr Words<Curve, 5> k_curves{{{"linear", Curve::linear},
                                           {"smoothstep", Curve::smoothstep},
                                           {"cubic_in", Curve::cubic_in},
                                           {"cubic_out", Curve::cubic_out},
                                           {"cubic_in_out", Curve::cubic_in_out}}};
inline constexpr Words<TransitionKind, 2> k_kinds{
    {{"feather", TransitionKind::feather}, {"inertialize", TransitionKind::inertialize}}};
inline constexpr Words<Interruption, 3> k_interruptions{
    {{"nobody", Interruption::nobody}, {"higher", Interruption::higher}, {"anyone", Interruption::anyone}}};
inline constexpr Words<Entry, 2> k_entries{{{"start", Entry::start}, {"keep", Entry::keep}}};
inline constexpr Words<ParameterKind, 3> k_parameter_kinds{
    {{"number", ParameterKind::number}, {"flag", ParameterKind::flag}, {"trigger", ParameterKind::trigger}}};
inline constexpr Words<Comparison, 6> k_comparisons{{{"<", Comparison::less},
                                                     {"<=", Comparison::less_equal},
                                                     {">", Comparison::greater},
                                                     {">=", Comparison::greater_equal},
                                                     {"==", Comparison::equal},
                                                     {"!=", Comparison::not_equal}}};

}  // namespace surefoot
