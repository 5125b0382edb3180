// Where the files lie that a URDF names: package://NAME/PATH, file:///PATH, and paths from the URDF's folder.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace chainreel {

struct FoundFile {
  std::string path;                   // "" where nothing was found
  std::vector<std::string> searched;  // every place looked at, in order
  std::string remedy;                 // what the user can do, where nothing was found
  bool by_tail = false;               // in none of the package's own places, see below
};

// package://NAME/PATH is looked for in
//   1. the folder that `packages` gives for NAME,
//   2. the nearest folder above the URDF with a package.xml, where its <name> is NAME,
//   3. the nearest folder above the URDF that is called NAME,
//   4. ROS_PACKAGE_PATH: FOLDER/NAME, or FOLDER where it is called NAME,
//   5. AMENT_PREFIX_PATH: FOLDER/share/NAME.
// Where that is in vain it is found by its tail:
//   6. in the folders called NAME that stand deeper in those of 1 to 3, as in NAME/robots/NAME,
//   7. where PATH goes through a folder that the URDF lies in, from there: robots/arm/meshes/m.stl below arm.
class FileFinder {
 public:
  FileFinder(const std::string& urdf_path, std::map<std::string, std::string> packages);

  const FoundFile& find(const std::string& name);

 private:
  std::vector<std::string> package_folders(const std::string& package) const;
  std::vector<std::string> own_folders(const std::string& package) const;
  const std::vector<std::string>& deeper_folders(const std::string& package);
  std::string find_by_tail(const std::string& package, const std::string& inside);

  std::string folder_;  // of the URDF, absolute
  std::map<std::string, std::string> packages_;
  std::string package_folder_, package_name_;  // of the nearest package.xml, or ""
  std::map<std::string, FoundFile> known_;
  std::map<std::string, std::vector<std::string>> deeper_;  // by package
};

// What to tell the user about a mesh of a link that was not found.
std::string missing_mesh_message(const std::string& link, const std::string& name, const FoundFile& found);

}  // namespace chainreel
