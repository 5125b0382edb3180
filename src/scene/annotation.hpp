// What entries of `annotate:` point at.
#pragma once

#include <string>
#include <vector>

#include "model/chain.hpp"
#include "scene/scene.hpp"

namespace chainreel {

// The frame of a link, or of the link behind a moving joint, by its name; -1: there is none.
int find_point(const Chain& chain, const std::string& name);
// The same, where a name of the scene's `frames` comes first.
int find_point(const Chain& chain, const Scene& scene, const std::string& name);
// That of a push.
int find_point(const Chain& chain, const PushEntry& push);
// All names that the first one knows.
std::vector<std::string> point_names(const Chain& chain);

// How long such words stand, s of the film: a little longer than it stands still for them.
double seconds_shown(const AnnotationEntry& entry);

// `panels`: the scenes of the page's panels, and their chains. Throws Error (bad input) at points that do not exist.
void check_annotations(const Scene& page, const std::vector<const Scene*>& panels,
                       const std::vector<const Chain*>& chains);

}  // namespace chainreel
