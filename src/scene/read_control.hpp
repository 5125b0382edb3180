// `torque:` as a mapping, or one entry of its list: csv, inverse_of, pd, computed_torque,
// gravity_compensation. Internal.
#pragma once

#include <string>

#include "scene/fields.hpp"
#include "sim/drive/control.hpp"

namespace chainreel {

Control read_control(Fields& fields, const YAML::Node& node, const std::string& key);

}  // namespace chainreel
