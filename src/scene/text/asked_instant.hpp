// An instant of a scene as people ask for one: `1.2s`, `0`, `event touch`.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "scene/text/picture_names.hpp"

namespace chainreel {

struct AskedInstant {
  double at = 0;      // s, where no event is meant
  std::string event;  // the first time that the event of this name happens
  std::string text;   // as it was written
  // "1.2s" or the event's name: one for an instant, however it was written.
  std::string name() const;
};

// As named_text, but events, whose own texts may hold signs of equality, have a name in front only of the word `event`.
NamedText named_instant(const std::string& part);

// Commas part instants, but not within brackets, max(1, 2), nor within the name of an event, where what follows is no instant.
std::vector<std::string> parted_instants(const std::string& text);

// Throws Error at `place`.
AskedInstant parse_asked_instant(const std::string& text, const Place& place);

// What keeps the scene from having that instant, with its remedy: it is over by then, or looks out for no
// such event; "" where only the run can tell.
std::string trouble_of_instant(const AskedInstant& asked, const Scene& scene);

}  // namespace chainreel
