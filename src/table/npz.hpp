// NumPy's archive of arrays: a zip file with an .npy file each. Internal to this floor.
#pragma once

#include <string>

#include "table/data_table.hpp"

namespace chainreel {

std::string npz_bytes(const DataTable& table);

}  // namespace chainreel
