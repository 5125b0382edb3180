#include "app/report/driving_tables.hpp"

#include <filesystem>

#include "core/csv.hpp"
#include "core/hash.hpp"

namespace chainreel {
namespace {

class Tables {
 public:
  void take(MotionEntry& motion) { add(motion.csv, sha256_of(*motion.table)); }
  void take(Control& control) {
    take(control.csv);
    take(control.inverse_of);
    if (control.pd) take(control.pd->trajectory);
    if (control.computed_torque) take(control.computed_torque->trajectory);
  }
  Json hashes() { return std::move(hashes_); }

 private:
  // Names alone stay in the key.
  void take(std::string& path) {
    if (!path.empty()) add(path, sha256_of(read_csv(path)));
  }
  void add(std::string& path, const std::string& hash) {
    path = std::filesystem::path(path).filename().string();
    const std::string others = hashes_.value(path, "");  // of another folder
    hashes_[path] = others + (others.empty() ? "" : " ") + hash;
  }

  Json hashes_ = Json::object();
};

}  // namespace

Json take_driving_tables(Scene& scene) {
  Tables tables;
  if (scene.motion) tables.take(*scene.motion);
  if (scene.control) tables.take(*scene.control);
  for (TorqueEntry& entry : scene.torque)
    if (entry.control) tables.take(*entry.control);
  return tables.hashes();
}

std::vector<std::string> table_changes(const Json& before, const Json& after, const std::string& key) {
  std::vector<std::string> changes;
  for (const auto& [name, hash] : after.items())
    if (before.contains(name) && before[name] != hash) changes.push_back(key + ": the numbers in table " + name + " differ");
  return changes;
}

}  // namespace chainreel
