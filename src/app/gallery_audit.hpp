// The numbers of an audit that people look for first.
#pragma once

#include <string>
#include <vector>

#include "core/json.hpp"

namespace chainreel {

struct AuditRow {
  std::string name;
  std::vector<std::string> values;  // one a run; "" where a run has none
};

// Of a film's audit: a row a number, a column a run. The first row holds the runs' titles where there are
// several. Values of an unexpected kind are left out.
std::vector<AuditRow> audit_rows(const Json& audit);

// "rk4, 3.00 s, 180 frames, energy error 1.2e-9 J"
std::string audit_facts(const Json& audit, double film_seconds);

}  // namespace chainreel
