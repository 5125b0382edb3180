// The scenes, models and guide that come with the program: beside the build, or under share/chainreel where it is
// installed. They are found from the program's own file, so that an installed tree can be moved.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace chainreel {

// The program's own file; where there is no /proc, as in bare roots, as it was called. Empty where neither tells.
std::filesystem::path program_file();

// Holds assets/scenes, assets/styles and models; "" where nothing lies where it is looked for.
std::string data_folder();

// Names of the scenes that come with the program, sorted.
std::vector<std::string> shipped_scenes();

// The file of such a scene or model: "rr_free" or "rr_free.yaml", "rr.urdf"; "" where there is none of that name.
std::string shipped_file(const std::string& name);

// The file that a scene may name so: a model, a style or its logo; "" where there is none of that name.
std::string shipped_input(const std::string& name);
// The name by which a scene or a suite anywhere may name this file; "" where it is none of those, nor a scene that comes with the program.
std::string name_of_shipped(const std::string& path);
// Of the models' names, where one is near: " Did you mean 'rr.urdf'?"; else all of them.
std::string near_shipped_models(const std::string& name);

// `named` itself where there is such a file or it is a path; else the file of that name which comes with the program. `ending`: what
// the name may lack, rr of rr.urdf, where no scene has it.
std::string found_file(const std::string& named, const std::string& ending = "");

// Of a name with an ending, which looks like a file here, and of which found_file gave another one: what is to be said. "": nothing.
std::string found_elsewhere(const std::string& named, const std::string& found);
// In words; `where`: "here".
std::string not_there(const std::string& named, const std::string& where, const std::string& found);

}  // namespace chainreel
