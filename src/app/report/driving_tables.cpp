#include "app/report/driving_tables.hpp"

#include <filesystem>

#include "core/csv.hpp"
#include "core/hash.hpp"

namespace chainreel {
namespace {

std::string name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

// Calls `visit` with the path of each table of a scene, constant or not, and the table where it has been read: else null.
template <class AnyScene, class Visit>
void for_each_table(AnyScene& scene, const Visit& visit) {
  const auto of_control = [&visit](auto& control) {
    for (auto* path : {&control.csv, &control.inverse_of})
      if (!path->empty()) visit(*path, nullptr);
    if (control.pd && !control.pd->trajectory.empty()) visit(control.pd->trajectory, nullptr);
    if (control.computed_torque && !control.computed_torque->trajectory.empty()) visit(control.computed_torque->trajectory, nullptr);
  };
  if (scene.motion) visit(scene.motion->csv, scene.motion->table.get());
  if (scene.control) of_control(*scene.control);
  for (auto& entry : scene.torque)
    if (entry.control) of_control(*entry.control);
}

}  // namespace

Json driving_tables(const Scene& scene) {
  Json hashes = Json::object();
  for_each_table(scene, [&](const std::string& path, const Table* table) {
    const std::string others = hashes.value(name_of(path), "");  // of another folder
    hashes[name_of(path)] = others + (others.empty() ? "" : " ") + (table != nullptr ? sha256_of(*table) : sha256_of(read_csv(path)));
  });
  return hashes;
}

Scene with_named_tables(Scene scene) {
  for_each_table(scene, [](std::string& path, const Table*) { path = name_of(path); });
  return scene;
}

std::vector<std::string> table_changes(const Json& before, const Json& after, const std::string& key) {
  std::vector<std::string> changes;
  for (const auto& [name, hash] : after.items())
    if (before.contains(name) && before[name] != hash) changes.push_back(key + ": the numbers in table " + name + " differ");
  return changes;
}

}  // namespace chainreel
