#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "bench/integrator_engines.hpp"

namespace chainreel::bench {
namespace {

template <class T>
T* checked(T* made) {
  if (!made) throw std::runtime_error("CVODE made nothing");
  return made;
}
void check(int result) {
  if (result < 0) throw std::runtime_error("CVODE refused: " + std::to_string(result));
}

// Adams' methods with fixed-point iteration, or BDF with Newton's and a Jacobian of differences.
class Cvode final : public EndFinder {
 public:
  Cvode(const MotionProblem& problem, bool stiff, std::vector<double> ladder)
      : EndFinder(stiff ? "CVODE BDF" : "CVODE Adams", std::move(ladder)),
        run_(problem.run),
        n_(std::size_t(run_.chain.nv)),
        system_(run_) {
    check(SUNContext_Create(nullptr, &context_));
    y_ = checked(N_VNew_Serial(sunindextype(2 * n_), context_));
    memory_ = checked(CVodeCreate(stiff ? CV_BDF : CV_ADAMS, context_));
    set_start();
    check(CVodeInit(memory_, rate, 0, y_));
    check(CVodeSetUserData(memory_, this));
    check(CVodeSStolerances(memory_, 1e-6, 1e-6));
    check(CVodeSetMaxNumSteps(memory_, -1));
    check(CVodeSetStopTime(memory_, run_.duration));
    if (stiff) {
      matrix_ = checked(SUNDenseMatrix(sunindextype(2 * n_), sunindextype(2 * n_), context_));
      linear_ = checked(SUNLinSol_Dense(y_, matrix_, context_));
      check(CVodeSetLinearSolver(memory_, linear_, matrix_));
    } else {
      iteration_ = checked(SUNNonlinSol_FixedPoint(y_, 0, context_));
      check(CVodeSetNonlinearSolver(memory_, iteration_));
    }
  }
  ~Cvode() override {
    CVodeFree(&memory_);
    if (iteration_) SUNNonlinSolFree(iteration_);
    if (linear_) SUNLinSolFree(linear_);
    if (matrix_) SUNMatDestroy(matrix_);
    N_VDestroy(y_);
    SUNContext_Free(&context_);
  }
  Cvode(const Cvode&) = delete;

  std::vector<double> end_of(double rung) override {
    set_start();
    check(CVodeReInit(memory_, 0, y_));
    check(CVodeSStolerances(memory_, rung, rung));
    check(CVodeSetStopTime(memory_, run_.duration));
    double t = 0;
    if (CVode(memory_, run_.duration, y_, &t, CV_NORMAL) < 0)
      return {std::numeric_limits<double>::quiet_NaN()};
    const double* const y = N_VGetArrayPointer(y_);
    return {y, y + n_};
  }

 private:
  void set_start() {
    double* const y = N_VGetArrayPointer(y_);
    std::copy(run_.q0.begin(), run_.q0.end(), y);
    std::copy(run_.qd0.begin(), run_.qd0.end(), y + n_);
  }

  static int rate(double t, N_Vector y_vector, N_Vector f_vector, void* self_pointer) {
    Cvode& self = *static_cast<Cvode*>(self_pointer);
    const double* const y = N_VGetArrayPointer(y_vector);
    double* const f = N_VGetArrayPointer(f_vector);
    std::copy_n(y + self.n_, self.n_, f);
    self.system_.acceleration(t, {y, self.n_}, {y + self.n_, self.n_}, {f + self.n_, self.n_});
    return 0;
  }

  const Simulation& run_;
  std::size_t n_;
  ChainSystem system_;
  SUNContext context_ = nullptr;
  N_Vector y_ = nullptr;
  void* memory_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
  SUNNonlinearSolver iteration_ = nullptr;
};

}  // namespace

std::unique_ptr<EndFinder> by_cvode(const MotionProblem& problem, bool stiff, std::vector<double> rungs) {
  return std::make_unique<Cvode>(problem, stiff, std::move(rungs));
}

std::string cvode_version() {
  char text[32] = {};
  SUNDIALSGetVersion(text, sizeof text);
  return text;
}

}  // namespace chainreel::bench
