#include "app/report/trajectory_csv.hpp"

#include <filesystem>
#include <vector>

#include "core/format.hpp"

namespace chainreel {
namespace {

std::string csv_head(const Chain& chain) {
  const bool plain = chain.serial && !chain.has_floating;
  std::string head = "t";
  const std::vector<std::string> q_names = position_names(chain);
  for (int i = 0; i < chain.nq; ++i)
    head += plain ? ",q" + std::to_string(i + 1) : ",q." + q_names[std::size_t(i)];
  for (int i = 0; i < chain.nv; ++i)
    head += plain ? ",qd" + std::to_string(i + 1) : ",qd." + chain.coordinate_names[std::size_t(i)];
  return head + "\n";
}

}  // namespace

std::string trajectory_csv(const Chain& chain, const Trajectory& trajectory) {
  std::string text = csv_head(chain);
  for (int k = 0; k < trajectory.size(); ++k) {
    text += format_exact(trajectory.t[std::size_t(k)]);
    for (double value : trajectory.q_at(k)) text += "," + format_exact(value);
    for (double value : trajectory.qd_at(k)) text += "," + format_exact(value);
    text += "\n";
  }
  return text;
}

std::string panel_csv_path(const std::string& path, std::size_t panel, bool alone) {
  if (alone) return path;
  std::filesystem::path result(path);
  const std::string ending = result.extension().string();
  return result.replace_extension(std::to_string(panel + 1) + ending).string();
}

}  // namespace chainreel
