// Films as one page for browsers, with all that is known of them, in one file without a server.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "app/gallery/gallery_clips.hpp"
#include "app/gallery/gallery_pictures.hpp"
#include "core/json.hpp"

namespace chainreel {

// Films are read while they are written, one piece after the other. The same films give the same page. Throws
// Error (exit 3) where one cannot be read any more.
void write_gallery(std::ostream& stream, const std::vector<GalleryClip>& clips, const std::vector<GalleryPicture>& pictures, const std::string& title);

// The numbers of an audit that people look for first.

struct AuditRow {
  std::string name;
  std::vector<std::string> values;  // one a run; "" where a run has none
};

// The table of a film's audit: a row a number, a column a run. The first row holds the runs' titles where there are
// several. Values of an unexpected kind are left out.
std::vector<AuditRow> audit_rows(const Json& audit);

// "rk4, 3.00 s, 180 frames, energy error 1.2e-9 J"
std::string audit_facts(const Json& audit, double film_seconds);

}  // namespace chainreel
