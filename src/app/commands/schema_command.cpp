// chainreel schema: the keys of a scene as a JSON Schema, for editors.

#include <cstdio>

#include "app/command.hpp"
#include "scene/schema.hpp"

namespace chainreel {

void add_schema_command(CommandLine& app) {
  Command* command = app.add_subcommand("schema", "a JSON Schema of scene files, for completion in editors");
  command->footer(
      "Into a file, and with the first line of a scene, editors with a YAML server complete and check it:\n"
      "# yaml-language-server: $schema=scene.schema.json\n"
      "Example: chainreel schema > scene.schema.json");
  command->callback([] { std::puts(scene_schema().dump(2).c_str()); });
}

}  // namespace chainreel
