// The key motion: a run that was recorded.
#pragma once

#include <memory>
#include <string>

#include "core/csv.hpp"
#include "core/error.hpp"

namespace chainreel {

struct MotionEntry {
  std::string csv;  // path
  ColumnNames columns;
  std::shared_ptr<const Table> table;  // what was read of it; not a part of the key
  Place place;
};

}  // namespace chainreel
