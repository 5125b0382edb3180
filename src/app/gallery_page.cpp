#include "app/gallery_page.hpp"

#include <filesystem>

#include "app/gallery_audit.hpp"
#include "app/page_template.hpp"
#include "app/signals.hpp"
#include "app/version.hpp"
#include "core/base64.hpp"
#include "core/format.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace {

Filler file_in_base64(const std::string& path) {
  return [path](std::ostream& stream) { write_base64_of_file(stream, path); };
}

std::string table_rows(const std::vector<AuditRow>& rows) {
  std::string html;
  for (const AuditRow& row : rows) {
    const bool head = row.name.empty();  // titles of the runs
    html += head ? "<thead><tr><td></td>" : "<tr><th scope=\"row\">" + escape_html(row.name) + "</th>";
    for (const std::string& value : row.values)
      html += (head ? "<th scope=\"col\">" : "<td>") + escape_html(value) + (head ? "</th>" : "</td>");
    html += head ? "</tr></thead>\n<tbody>\n" : "</tr>\n";
  }
  return html;
}

Filler audit_of(const Json& audit) {
  if (!audit.is_object()) return markup("");
  return markup(filled_page(embedded_page("audit.html"), {{"rows", markup(table_rows(audit_rows(audit)))},
                                                          {"json", plain(audit.dump(2))}}));
}

// The pictures are read when it is their turn.
Filler charts_of(const std::vector<GalleryChart>& charts) {
  if (charts.empty()) return markup("");
  return [&charts](std::ostream& stream) {
    const Filler figures = [&charts](std::ostream& out) {
      for (const GalleryChart& chart : charts)
        fill_page(out, embedded_page("chart.html"),
                  {{"title", plain(chart.title)},
                   {"file", plain(std::filesystem::path(chart.path).filename().string())},
                   {"picture", file_in_base64(chart.path)}});
    };
    const std::string count = charts.size() == 1 ? "Chart" : std::to_string(charts.size()) + " charts";
    fill_page(stream, embedded_page("charts.html"), {{"summary", plain(count)}, {"figures", figures}});
  };
}

Filler scene_of(const GalleryClip& clip, const std::string& id) {
  if (clip.scene.empty())
    return markup(filled_page(embedded_page("no_scene.html"), {{"reason", plain(clip.why_no_scene)}}));
  return markup(
      filled_page(embedded_page("scene.html"),
                  {{"id", plain(id)}, {"file", plain(clip.name + ".yaml")}, {"text", plain(clip.scene)}}));
}

void write_card(std::ostream& stream, const GalleryClip& clip, const std::string& id) {
  fill_page(stream, embedded_page("card.html"),
            {{"id", plain(id)},
             {"file", plain(std::filesystem::path(clip.path).filename().string())},
             {"type", plain(clip.type)},
             {"width", plain(std::to_string(clip.start.width))},
             {"height", plain(std::to_string(clip.start.height))},
             {"poster", markup(base64(png_bytes(clip.start.frame)))},
             {"film", file_in_base64(clip.path)},
             {"title", plain(clip.title)},
             {"words", plain(clip.words)},
             {"facts", plain(audit_facts(clip.audit, clip.start.seconds))},
             {"audit", audit_of(clip.audit)},
             {"charts", charts_of(clip.charts)},
             {"scene", scene_of(clip, id)}});
}

}  // namespace

void write_gallery(std::ostream& stream, const std::vector<GalleryClip>& clips, const std::string& title) {
  double seconds = 0;
  for (const GalleryClip& clip : clips) seconds += clip.start.seconds;
  const std::string summary = (clips.size() == 1 ? "One film" : std::to_string(clips.size()) + " films") +
                              ", " + format_fixed(seconds, 1) + " s together.";
  const Filler cards = [&clips](std::ostream& out) {
    for (std::size_t i = 0; i < clips.size(); ++i) {
      throw_if_interrupted();
      write_card(out, clips[i], "clip-" + std::to_string(i + 1));
    }
  };
  fill_page(stream, embedded_page("gallery.html"),
            {{"title", plain(title)},
             {"generator", plain(std::string("chainreel ") + program_version())},
             {"summary", plain(summary)},
             {"style", markup(std::string(embedded_page("gallery.css")))},
             {"script", markup(std::string(embedded_page("gallery.js")))},
             {"cards", cards}});
}

}  // namespace chainreel
