// The recursions, over any algebra. Their texts stand in kinematics.cpp, rnea.cpp, crba.cpp and aba.cpp.
#pragma once

#include <span>

#include "dynamics/links.hpp"

namespace chainreel {

template <class A>
using ScalarSpan = std::span<typename A::Scalar>;
template <class A>
using ConstScalarSpan = std::span<const typename A::Scalar>;

// X, S, I of every body at q. All that follows uses them.
template <class A>
void place(Links<A>& links, ConstScalarSpan<A> q);

// pose of every body in the world.
template <class A>
void locate(Links<A>& links);

// v of every body.
template <class A>
void move(Links<A>& links, ConstScalarSpan<A> qd);

// v and a of every body, in a world that accelerates by `base` (-gravity, or zero to leave gravity out).
template <class A>
void accelerate(Links<A>& links, const typename A::Motion& base, ConstScalarSpan<A> qd,
                ConstScalarSpan<A> qdd);

// v, a, f of every body and tau, in a world that accelerates by `base`.
template <class A>
void rnea(Links<A>& links, const typename A::Motion& base, ConstScalarSpan<A> qd, ConstScalarSpan<A> qdd,
          ScalarSpan<A> tau);

// After place and locate: the velocity along the world's axes, for each unit rate, of `point`, which is fixed
// in body `i` and given in the world. Column by column, in each the last `rows` of A::rows.
template <class A>
void jacobian(const Links<A>& links, std::size_t i, const typename A::Point& point, std::size_t rows,
              std::size_t nv, typename A::Scalar* J);

// The mass matrix, n x n, row by row, both halves.
template <class A>
void crba(Links<A>& links, std::size_t n, typename A::Scalar* M);

// qdd, in a world that accelerates by `base`. No two bodies may share a coordinate.
template <class A>
void aba(Links<A>& links, const typename A::Motion& base, ConstScalarSpan<A> qd, ConstScalarSpan<A> tau,
         ScalarSpan<A> qdd);

}  // namespace chainreel
