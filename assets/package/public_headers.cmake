# The headers that other programs may include, by the library that they belong to: with all that they include themselves, and
# nothing else. They are installed in include/chainreel, and include one another by that name.
set(dynamics_headers
  core/error.hpp core/names.hpp
  model/chain.hpp model/link_chain.hpp model/model_source.hpp model/read_chain.hpp
  dynamics/effective_mass.hpp dynamics/energy.hpp dynamics/equation_of_motion.hpp dynamics/friction.hpp
  dynamics/inverse_kinematics.hpp dynamics/kinematics.hpp dynamics/lagrange.hpp dynamics/workspace.hpp)
set(sim_headers
  core/csv.hpp core/scalar.hpp expr/affine.hpp expr/corners.hpp expr/expression.hpp expr/program.hpp
  integrate/dense_lu.hpp integrate/integrator.hpp integrate/method.hpp integrate/system.hpp model/constraint.hpp
  model/urdf_file.hpp model/urdf_problems.hpp model/visuals.hpp dynamics/algebra.hpp
  dynamics/constraints/constrained_dynamics.hpp dynamics/constraints/constrained_workspace.hpp
  dynamics/constraints/constraint_projection.hpp dynamics/constraints/constraint_set.hpp
  dynamics/kernels/constrained_kernel.hpp dynamics/kernels/kernel_planar.hpp dynamics/kernels/kernel_spatial.hpp
  dynamics/kernels/taylor_planar.hpp sim/audit.hpp sim/drive/control.hpp sim/drive/limits.hpp sim/drive/pushes.hpp
  sim/drive/linear_drive.hpp sim/drive/probe.hpp sim/drive/reference.hpp sim/drive/state_corners.hpp sim/drive/task_torque.hpp
  sim/drive/torque.hpp sim/drive/torque_function.hpp sim/plots.hpp sim/simulate.hpp sim/system/chain_system.hpp
  sim/system/constrained_chain.hpp sim/system/constraint_plan.hpp sim/system/even_sides.hpp sim/system/trajectory.hpp
  sim/watch/events.hpp
  sim/watch/first_instant.hpp)
set(film_headers app/library/scene_run.hpp core/image.hpp core/large_memory.hpp)
