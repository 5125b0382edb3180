// The torques of a run at its samples, and which of them are to be seen.
#pragma once

#include <string>
#include <vector>

#include "draw/page/stage.hpp"

namespace chainreel {

class TorqueRun {
 public:
  TorqueRun(const Stage& stage, const StagedRun& motion);

  // Whether any acts for which no spring stands; else nothing but `shows` may be asked.
  bool shows_any() const;
  bool shows(int freedom) const { return shown_[std::size_t(freedom)]; }
  const double* at(int k) const { return tau_.data() + std::size_t(k) * nv_; }  // of all freedoms
  double ring(int freedom, int k) const { return rings_[std::size_t(freedom)][std::size_t(k)]; }
  // Whether it is too small for a name, but only for a moment.
  bool keeps_name(int freedom, int k) const { return named_[std::size_t(freedom)][std::size_t(k)]; }
  double extreme(int freedom, int k) const { return extremes_[std::size_t(freedom)][std::size_t(k)]; }
  bool is_labelled() const { return labelled_; }
  std::string word(int freedom) const { return nv_ == 1 ? "tau" : "tau_{" + std::to_string(freedom + 1) + "}"; }

 private:
  std::vector<double> of_freedom(const std::vector<double>& tau, std::size_t i) const;
  void find_names(std::size_t i, double least, int keeps);

  std::size_t nv_;
  std::vector<double> tau_;                 // nv a sample
  std::vector<bool> shown_;                 // a freedom
  std::vector<std::vector<double>> rings_;  // a freedom that is shown, a sample
  std::vector<std::vector<double>> extremes_;  // ... the same
  std::vector<std::vector<bool>> named_;  // ... the same
  bool labelled_ = true;
};

}  // namespace chainreel
