#include "house/packages.hpp"

#include <regex>
#include <sstream>
#include <stdexcept>

namespace chainreel {

std::map<std::string, std::set<std::string>> read_packages(std::string_view text) {
  static const std::regex section(R"(\[([a-z]+)\])"), package(R"([a-z0-9][a-z0-9+.-]+)");
  std::map<std::string, std::set<std::string>> result;
  std::istringstream lines{std::string(text)};
  std::string line, current;
  while (std::getline(lines, line)) {
    line = line.substr(0, line.find('#'));
    line.erase(line.find_last_not_of(" \t") + 1);
    std::smatch match;
    if (line.empty()) continue;
    if (std::regex_match(line, match, section)) {
      current = match[1];
      result[current];
    } else if (!current.empty() && std::regex_match(line, package)) {
      result[current].insert(line);
    } else {
      throw std::runtime_error("packages.txt: neither section nor package: " + line);
    }
  }
  return result;
}

std::set<std::string> packages_named_by(std::string_view page) {
  static const std::regex install(R"(\bapt(-get)?\s+install\s+((?:[^\n`&|;\\]|\\\n)*))");
  std::set<std::string> result;
  const std::string text(page);
  for (std::sregex_iterator at(text.begin(), text.end(), install), end; at != end; ++at) {
    std::istringstream words((*at)[2].str());
    for (std::string word; words >> word;)
      // A path is a package that one has, of no list.
      if (word[0] != '-' && word != "\\" && word.find('/') == std::string::npos) result.insert(word);
  }
  return result;
}

}  // namespace chainreel
