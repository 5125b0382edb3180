// The loop of a run allocates nothing.
#include <gtest/gtest.h>

#include "dynamics/energy.hpp"
#include "dynamics/equation_of_motion.hpp"
#include "dynamics/friction.hpp"
#include "dynamics/kinematics.hpp"
#include "support/allocation_count.hpp"
#include "support/chains.hpp"

namespace chainreel::test {
namespace {

void use_everything(const Chain& chain, Workspace& ws, const State& s, std::vector<double>& q) {
  compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
  if (!chain.has_mimic) compute_aba(chain, ws, s.q, s.qd, s.tau);
  compute_inverse_dynamics(chain, ws, s.q, s.qd, s.qdd);
  compute_nle(chain, ws, s.q, s.qd);
  compute_gravity_torque(chain, ws, s.q);
  compute_friction(chain, ws, s.qd);
  compute_mass_matrix(chain, ws, s.q);
  compute_kinematics(chain, ws, s.q, s.qd);
  compute_jacobian(chain, ws, s.q, chain.end_effector, Task::linear);
  compute_jacobian_rate(chain, ws, s.q, s.qd, chain.end_effector, Task::linear);
  energy_of(chain, ws, s.q, s.qd);
  q_rate(chain, s.q, s.qd, q);
  advance(chain, q, s.qd, 1e-3);
  normalize(chain, q);
}

TEST(AllocationTest, NothingIsAllocatedAfterTheFirstCall) {
  Random random(81);
  for (const Chain& chain :
       {rr_chain(), rrr_chain(), pp_chain(), arm_chain(1), random_tree(82, {.bodies = 12, .mimic = 0.4}),
        random_tree(83, {.bodies = 12, .floating_base = true}), random_planar_tree(84, {.bodies = 12})}) {
    Workspace ws(chain);
    const State s = random_state(chain, random);
    std::vector<double> q = s.q;
    use_everything(chain, ws, s, q);  // dense matrices are sized where they are first asked for
    const long before = allocation_count();
    use_everything(chain, ws, s, q);
    EXPECT_EQ(allocation_count() - before, 0) << chain.name;
  }
}

TEST(AllocationTest, ForwardDynamicsAllocatesNotEvenTheFirstTime) {
  Random random(85);
  for (const Chain& chain : {rr_chain(), arm_chain(1), random_tree(82, {.bodies = 12, .mimic = 0.4})}) {
    Workspace ws(chain);
    const State s = random_state(chain, random);
    const long before = allocation_count();
    compute_forward_dynamics(chain, ws, s.q, s.qd, s.tau);
    EXPECT_EQ(allocation_count() - before, 0) << chain.name;
  }
}

TEST(AllocationTest, MakingAWorkspaceIsCounted) {
  const Chain chain = rr_chain();
  const long before = allocation_count();
  const Workspace ws(chain);
  EXPECT_GT(allocation_count() - before, 0);
}

}  // namespace
}  // namespace chainreel::test
