// What is spoilt, and which command is given it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "fuzz/mutate.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {

// Files by their names, and what to call in their folder, where `models` leads to those of the source.
struct Case {
  std::map<std::string, std::string> files;
  std::vector<std::string> arguments;
};

class Subjects {
 public:
  Subjects();  // reads what is to be spoilt; has the program make clips of every kind
  static const std::vector<std::string>& kinds();
  Case make(const std::string& kind, Dice& dice);

 private:
  Case scene(Dice& dice) const;
  Case expression(Dice& dice) const;
  Case urdf(Dice& dice) const;
  Case table(Dice& dice) const;
  Case mesh(Dice& dice) const;
  Case clip(Dice& dice);
  Case command_line(Dice& dice) const;
  void make_clips();

  std::vector<std::string> scenes_, models_, keys_;
  std::map<std::string, std::string> clips_;  // by name
};

}  // namespace chainreel
