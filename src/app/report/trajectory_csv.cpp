#include "app/report/trajectory_csv.hpp"

#include <filesystem>
#include <vector>

#include "core/format.hpp"

namespace chainreel {

std::string state_names(const Chain& chain) {
  const bool plain = chain.serial && !chain.has_floating;
  std::string names;
  const std::vector<std::string> q_names = position_names(chain);
  for (int i = 0; i < chain.nq; ++i)
    names += (names.empty() ? "q" : ",q") + (plain ? std::to_string(i + 1) : "." + q_names[std::size_t(i)]);
  for (int i = 0; i < chain.nv; ++i)
    names += ",qd" + (plain ? std::to_string(i + 1) : "." + chain.coordinate_names[std::size_t(i)]);
  return names;
}

std::string state_text(const Trajectory& trajectory, int k) {
  std::string text;
  for (const auto& values : {trajectory.q_at(k), trajectory.qd_at(k)})
    for (const double value : values) text += (text.empty() ? "" : ",") + format_exact(value);
  return text;
}

std::string trajectory_csv(const Chain& chain, const Trajectory& trajectory) {
  std::string text = "t," + state_names(chain) + "\n";
  for (int k = 0; k < trajectory.size(); ++k)
    text += format_exact(trajectory.t[std::size_t(k)]) + "," + state_text(trajectory, k) + "\n";
  return text;
}

std::string panel_csv_path(const std::string& path, std::size_t panel, bool alone) {
  if (alone) return path;
  std::filesystem::path result(path);
  const std::string ending = result.extension().string();
  return result.replace_extension(std::to_string(panel + 1) + ending).string();
}

}  // namespace chainreel
