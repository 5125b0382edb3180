// A motion that was recorded and is shown as it was: nothing is computed of it but what it takes. Its coordinates are those of
// a table, between the rows cubic splines; rates and accelerations the table's own where it has them, else the derivatives
// of the spline of what it has. Its first row is t = 0.
//
// Of a smooth motion sampled every h, errors are those of the spline (C. de Boor, A Practical Guide to Splines, ch. V): of
// q h^4, of a first derivative h^3 and of a second h^2; at the rows within, a first derivative has h^4.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/csv.hpp"
#include "integrate/integrator.hpp"
#include "model/chain.hpp"
#include "sim/drive/reference.hpp"
#include "sim/drive/torque.hpp"

namespace chainreel {

class RecordedMotion final : public Reference {
 public:
  // `table` as read_log tells it. Throws Error (bad input) where it is no motion of the chain: a floating
  // base, fewer than two rows, missing columns, a unit of another kind, an angle that jumps by more than half a turn.
  RecordedMotion(const Chain& chain, std::shared_ptr<const Table> table, const ColumnNames& names);

  // Beyond the ends, where instants are but rounded, the state at that end.
  void evaluate(double t, Vec q, Vec qd, Vec qdd) const override;
  double price(bool with_acceleration) const override { return splines_->price(with_acceleration); }
  std::vector<double> breaks(double end) const override { return splines_->breaks(end); }

  double end() const { return end_; }  // s, of its last row
  std::size_t rows() const { return table_->rows(); }
  double instant(std::size_t row) const { return t_[row]; }  // s, since the first
  std::vector<double> told_instants() const;                 // s, as the table has them
  const Table& table() const { return *table_; }
  bool has_rates() const { return has_rates_; }
  bool has_accelerations() const { return has_accelerations_; }
  std::string sha256() const { return sha256_of(*table_); }  // of the table

  // How far torques are at most from those of inverse dynamics at its rows.
  struct OwnTorques {
    double largest = 0;  // N m or N
    double t = 0;        // s
    std::string freedom;
  };
  // The table's own; nothing where it has none.
  const std::optional<OwnTorques>& own_torques() const { return own_torques_; }
  // Those of splines through every other row alone: of a smooth motion three times as far as the torques are off themselves, where
  // accelerations jump about as far. Nothing where the table tells accelerations, or has few rows.
  const std::optional<OwnTorques>& coarse_torques() const { return coarse_torques_; }
  // The same from other torques than those of the free chain, a row as long as the chain's freedoms at each of its rows.
  std::optional<OwnTorques> own_torques_beside(const std::vector<double>& tau) const;

  // What one should know who believes its picture, a sentence each; `own`: how far its own torques are from those that are told.
  std::vector<std::string> remarks(const std::optional<OwnTorques>& own) const;
  std::vector<std::string> remarks() const { return remarks(own_torques_); }
  // What speaks against its units, likewise: angles of more than a turn and rows far apart, where no unit is told.
  const std::vector<std::string>& doubts() const { return doubts_; }

 private:
  void doubt_splines(const Chain& chain, const TimeTable& motion);

  std::shared_ptr<const Table> table_;
  std::unique_ptr<Reference> splines_;
  std::vector<double> t_;
  double end_ = 0, second_ = 1;  // s, of the last row; of one of the table's units of time
  bool has_rates_ = false, has_accelerations_ = false;
  std::vector<std::string> freedoms_;
  std::vector<std::vector<double>> recorded_torques_;  // of each freedom, a number a row; none
  std::optional<OwnTorques> own_torques_, coarse_torques_;
  std::vector<std::string> remarks_, doubts_;
};

// M qdd + nle + tau_f along it, zero where it is rounding of the parts that it is the sum of: what nothing drives is to be
// seen as such.
std::unique_ptr<TorqueLaw> make_replay_torque(const Chain& chain, std::shared_ptr<const RecordedMotion> motion);

// What a run is stepped by that shows a recorded motion: from row to row.
std::unique_ptr<Integrator> make_player(std::shared_ptr<const RecordedMotion> motion, int nv);

}  // namespace chainreel
