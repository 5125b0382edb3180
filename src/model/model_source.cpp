#include "model/model_source.hpp"

#include "core/hash.hpp"
#include "model/xml_text.hpp"

namespace chainreel {

std::string ModelSource::urdf() const {
  return links ? urdf_of(*links, "chain") : read_xml_text(path);
}

std::string ModelSource::sha256() const {
  return links ? sha256_of(urdf()) : sha256_of_file(path);
}

std::string ModelSource::elements_sha256() const {
  return sha256_of_elements(urdf(), path);
}

}  // namespace chainreel
