#include "app/gallery/gallery_page.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>

#include "app/cli/streams.hpp"
#include "app/report/page_template.hpp"
#include "app/report/version.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "encode/png.hpp"
#include "integrate/method.hpp"
#include "picture/formula_words.hpp"

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

void write_figure(std::ostream& stream, const std::string& title, const std::string& type, const std::string& path) {
  fill_page(stream, embedded_page("chart.html"),
            {{"title", plain(title)},
             {"type", plain(type)},
             {"file", plain(std::filesystem::path(path).filename().string())},
             {"picture", file_in_base64(path)}});
}

// The pictures are read when it is their turn.
Filler charts_of(const std::vector<GalleryChart>& charts) {
  if (charts.empty()) return markup("");
  return [&charts](std::ostream& stream) {
    const Filler figures = [&charts](std::ostream& out) {
      for (const GalleryChart& chart : charts)
        write_figure(out, chart.title, "image/png", chart.path);
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

// A film with its controls; of pictures that move by themselves the picture.
Filler moving_of(const GalleryClip& clip, const std::string& id) {
  return [&clip, id](std::ostream& stream) {
    const Point button = button_place(clip.start.frame);
    fill_page(stream, embedded_page(clip.type.starts_with("image/") ? "moving_picture.html" : "film.html"),
              {{"id", plain(id)},
               {"type", plain(clip.type)},
               {"width", plain(std::to_string(clip.start.width))},
               {"height", plain(std::to_string(clip.start.height))},
               {"poster", markup(base64(png_bytes(clip.start.frame)))},
               {"button_left", plain(format_fixed(100 * button.x, 1))},
               {"button_top", plain(format_fixed(100 * button.y, 1))},
               {"poster_at", plain(format_fixed(poster_time(clip.audit, clip.start.seconds), 3))},
               {"words", plain(clip.words)},
               {"film", file_in_base64(clip.path)}});
  };
}

void write_card(std::ostream& stream, const GalleryClip& clip, const std::string& id) {
  fill_page(stream, embedded_page("card.html"),
            {{"id", plain(id)},
             {"file", plain(std::filesystem::path(clip.path).filename().string())},
             {"moving", moving_of(clip, id)},
             {"title", plain(clip.title)},
             {"words", plain(clip.words)},
             {"facts", plain(audit_facts(clip.audit, clip.start.seconds))},
             {"audit", audit_of(clip.audit)},
             {"charts", charts_of(clip.charts)},
             {"scene", scene_of(clip, id)}});
}

// The pictures below the films, read when it is their turn.
Filler section_of(const std::vector<GalleryPicture>& pictures) {
  if (pictures.empty()) return markup("");
  return [&pictures](std::ostream& stream) {
    const Filler figures = [&pictures](std::ostream& out) {
      for (const GalleryPicture& one : pictures) {
        throw_if_interrupted();
        write_figure(out, one.title, one.type, one.path);
      }
    };
    fill_page(stream, embedded_page("pictures.html"), {{"figures", figures}});
  };
}

// "One film, 3.0 s long, and 2 pictures."
std::string summary_of(const std::vector<GalleryClip>& clips, const std::vector<GalleryPicture>& pictures) {
  double seconds = 0;
  for (const GalleryClip& clip : clips) seconds += clip.start.seconds;
  std::string text;
  if (!clips.empty()) text = (clips.size() == 1 ? "One film, " : std::to_string(clips.size()) + " films, ") + format_fixed(seconds, 1) + (clips.size() == 1 ? " s long" : " s together");
  if (pictures.empty()) return text + ".";
  return text + (text.empty() ? "" : ", and ") + (pictures.size() == 1 ? "one picture." : std::to_string(pictures.size()) + " pictures.");
}

}  // namespace

void write_gallery(std::ostream& stream, const std::vector<GalleryClip>& clips, const std::vector<GalleryPicture>& pictures, const std::string& title) {
  const Filler cards = [&clips](std::ostream& out) {
    for (std::size_t i = 0; i < clips.size(); ++i) {
      throw_if_interrupted();
      write_card(out, clips[i], "clip-" + std::to_string(i + 1));
    }
  };
  fill_page(stream, embedded_page("gallery.html"),
            {{"title", plain(title)},
             {"generator", plain(std::string("chainreel ") + program_version())},
             {"summary", plain(summary_of(clips, pictures))},
             {"style", markup(std::string(embedded_page("gallery.css")))},
             {"script", markup(std::string(embedded_page("gallery.js")))},
             {"cards", cards},
             {"pictures", section_of(pictures)}});
}

namespace {

constexpr int kErrorDigits = 2;

std::string number_text(const Json& run, const char* key, int digits, const char* unit) {
  if (!run.contains(key) || !run[key].is_number()) return "";
  return format_significant(run[key].get<double>(), digits) + unit;
}

std::string word(const Json& run, const char* key) {
  return run.contains(key) && run[key].is_string() ? run[key].get<std::string>() : "";
}

// Digit by digit, as whole numbers are.
std::string count_text(const Json& run, const char* key) {
  return run.contains(key) && run[key].is_number_integer() ? std::to_string(run[key].get<long>()) : "";
}

std::string energy_error(const Json& run) {
  const std::string error = number_text(run, "energy_error", kErrorDigits, " J");
  if (error.empty()) return "";
  const std::string scale = number_text(run, "largest_kinetic_energy", 3, " J");
  return scale.empty() ? error : error + " (kinetic energy up to " + scale + ")";
}

std::string method_line(const Json& run) {
  std::string text = method_title(word(run, "method"));
  if (text.empty()) return "";
  const std::string order = count_text(run, "order"), tolerance = number_text(run, "tolerance", 3, "");
  const std::string step = number_text(run, "step", 6, " s");
  if (!order.empty()) text += ", order " + order;
  if (!tolerance.empty()) text += ", tolerance " + tolerance;
  if (!step.empty()) text += ", step " + step;
  return run.contains("auto") && !run["auto"].is_null() ? text + " (chosen automatically)" : text;
}

std::string status_words(const Json& run) {
  std::string text = word(run, "status");
  if (const std::string trouble = word(run, "trouble"); !trouble.empty()) text += ": " + trouble;
  return text;
}

std::string event_words(const Json& run) {
  if (!run.contains("events") || !run["events"].is_array()) return "";
  std::string text;
  for (const Json& event : run["events"]) {
    const std::string at = number_text(event, "t", 6, " s");
    if (!at.empty()) text += (text.empty() ? "" : "; ") + word(event, "name") + " at t = " + at;
  }
  return text;
}

std::string constraint_words(const Json& run) {
  if (!run.contains("constraint_error") || !run["constraint_error"].is_object()) return "";
  return number_text(run["constraint_error"], "position_error", kErrorDigits, " m");
}

struct Row {
  const char* name;
  std::function<std::string(const Json&)> value;
};

const std::vector<Row>& rows() {
  static const std::vector<Row> all{
      {"Energy error", &energy_error},
      {"Method", &method_line},
      {"Steps", [](const Json& run) { return count_text(run, "steps"); }},
      {"Evaluations", [](const Json& run) { return count_text(run, "evaluations"); }},
      {"Ended", &status_words},
      {"Duration", [](const Json& run) { return number_text(run, "duration", 6, " s"); }},
      {"Events", &event_words},
      {"Distance from constraints", &constraint_words},
      {"Frames", [](const Json& run) { return count_text(run, "frames"); }},
      {"Model", [](const Json& run) { return word(run, "model"); }},
      {"Trajectory SHA-256", [](const Json& run) { return word(run, "trajectory_sha256"); }},
  };
  return all;
}

// Each with what all of them share.
std::vector<Json> runs_of(const Json& audit) {
  if (!audit.contains("panels") || !audit["panels"].is_array() || audit["panels"].empty()) return {audit};
  std::vector<Json> runs;
  for (const Json& panel : audit["panels"]) {
    runs.push_back(audit);
    runs.back().erase("panels");
    if (panel.is_object()) runs.back().update(panel);
  }
  return runs;
}

}  // namespace

std::vector<AuditRow> audit_rows(const Json& audit) {
  const std::vector<Json> runs = runs_of(audit);
  std::vector<AuditRow> table;
  if (runs.size() > 1) {
    table.push_back({"", {}});
    for (const Json& run : runs) table.back().values.push_back(in_plain_words(word(run, "title")));
  }
  for (const Row& row : rows()) {
    AuditRow filled{row.name, {}};
    for (const Json& run : runs) filled.values.push_back(row.value(run));
    if (std::any_of(filled.values.begin(), filled.values.end(),
                    [](const std::string& v) { return !v.empty(); }))
      table.push_back(std::move(filled));
  }
  return table;
}

namespace {

// Of a few panels each one's, in their order: of some comparisons they are the point. "" where none is known.
std::string errors_of(const std::vector<Json>& runs) {
  constexpr std::size_t kMostNamed = 4;
  std::string errors;
  bool any = false;
  for (const Json& run : runs) {
    const std::string error = number_text(run, "energy_error", kErrorDigits, " J");
    any = any || !error.empty();
    errors += (errors.empty() ? "" : ", ") + (error.empty() ? "unknown" : error);
  }
  if (!any || runs.size() > kMostNamed) return "";
  return (runs.size() == 1 ? "energy error " : "energy errors ") + errors;
}

}  // namespace

std::string audit_facts(const Json& audit, double film_seconds) {
  std::vector<std::string> facts;
  const std::vector<Json> runs = runs_of(audit.is_object() ? audit : Json::object());
  if (runs.size() > 1) facts.push_back(std::to_string(runs.size()) + " panels");
  if (runs.size() == 1) facts.push_back(method_title(word(runs.front(), "method")));
  facts.push_back(format_fixed(film_seconds, 2) + " s");
  const std::string frames = runs.empty() ? "" : count_text(runs.front(), "frames");
  if (!frames.empty()) facts.push_back(frames + " frames");
  if (const std::string errors = errors_of(runs); !errors.empty()) facts.push_back(errors);
  std::string text;
  for (const std::string& fact : facts)
    if (!fact.empty()) text += (text.empty() ? "" : " \u00B7 ") + fact;
  return text;
}

}  // namespace chainreel
