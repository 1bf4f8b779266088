#pragma once
template <int D, class... Others>
using ConstraintList = std::variant<HeldPosition<D>, Others...>;
