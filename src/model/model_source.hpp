// Where a mechanism stands: in a URDF file, or in a few numbers that stand for one.
#pragma once

#include <optional>
#include <string>

#include "core/error.hpp"
#include "model/link_chain.hpp"

namespace chainreel {

struct ModelSource {
  std::string path;                // of the URDF file; of numbers, the file that holds them
  std::optional<LinkChain> links;  // complete
  Place place;                     // of numbers, for errors

  ModelSource() = default;
  ModelSource(std::string file) : path(std::move(file)) {}  // NOLINT: a path is a source
  ModelSource(const char* file) : path(file) {}

  // In messages and reports: the path, or the numbers in one line of YAML.
  std::string words() const { return links ? text_of(*links) : path; }
  // The URDF's text; of a file, read within limits. Throws Error as read_xml_text does.
  std::string urdf() const;
  // Of the URDF's bytes.
  std::string sha256() const;
  // Of what it says: comments and line breaks are no part of it.
  std::string elements_sha256() const;

  friend bool operator==(const ModelSource& a, const ModelSource& b) { return a.path == b.path && a.links == b.links; }
};

}  // namespace chainreel
