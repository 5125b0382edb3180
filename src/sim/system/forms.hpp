// A chain under a torque law in the form that a method asks for.
#pragma once

#include <memory>
#include <string>

#include "dynamics/local_coordinates.hpp"
#include "dynamics/momentum_form.hpp"
#include "integrate/method.hpp"
#include "integrate/system.hpp"
#include "sim/system/chain_system.hpp"

namespace chainreel {

// A chain with floating joints in local coordinates, where it is a system with q' = v.

class ChainChart final : public SecondOrder, public Chart {
 public:
  // `system` must outlive it.
  explicit ChainChart(ChainSystem& system);

  // As a system: q, v of SecondOrder are x, x'.
  int nq() const override { return system_.nv(); }
  int nv() const override { return system_.nv(); }
  void acceleration(double t, std::span<const double> x, std::span<const double> x_dot,
                    std::span<double> x_ddot) override;

  int own_coordinates() const override { return system_.nq(); }
  void move_to(std::span<const double> q, std::span<const double> v, std::span<double> x,
               std::span<double> x_dot) override;
  void leave(std::span<const double> x, std::span<const double> x_dot, std::span<double> q,
             std::span<double> v) const override;

  const LocalCoordinates& local() const { return local_; }

 private:
  ChainSystem& system_;
  LocalCoordinates local_;
  std::vector<double> q_, v_, v_dot_;
};

class ChainForms {
 public:
  // Makes the form that the method's row names. Throws Error (bad input) that says why this chain or torque
  // has none, and which method to take instead. `system` must outlive it.
  ChainForms(ChainSystem& system, const Method& method);
  ~ChainForms();

  const Forms& forms() const { return forms_; }

 private:
  Forms forms_;
  std::unique_ptr<ChainChart> chart_;  // where the method needs plain coordinates and the chain has none
  std::unique_ptr<Momenta> momenta_;
  std::unique_ptr<Series> series_;
  std::unique_ptr<LinkedPoints> linked_points_;
};

// A chain under a torque law in coordinates and momenta; with floating joints, in local coordinates x and the
// momenta that belong to them.

class ChainMomenta final : public Momenta {
 public:
  // `local`: of a chain with floating joints, else null. Both must outlive it.
  ChainMomenta(ChainSystem& system, const LocalCoordinates* local);

  int n() const override { return system_.nv(); }
  bool is_separable() const override { return separable_; }
  void momentum(std::span<const double> q, std::span<const double> v, std::span<double> p) override;
  void velocity(std::span<const double> q, std::span<const double> p, std::span<double> v) override;
  void force(double t, std::span<const double> q, std::span<const double> v,
             std::span<double> p_dot) override;

 private:
  void own_force(double t, std::span<const double> q, std::span<const double> v, std::span<double> p_dot);

  ChainSystem& system_;
  MomentumForm form_;
  bool separable_;
  const LocalCoordinates* local_;
  std::vector<double> own_q_, own_v_, own_p_, own_p_dot_;  // of a chain with floating joints
};

}  // namespace chainreel
