// The table of keys as a JSON Schema (draft 07), with which editors complete and check scene files.
#pragma once

#include "core/json.hpp"

namespace chainreel {

Json scene_schema();

}  // namespace chainreel
