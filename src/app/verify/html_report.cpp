#include "app/verify/html_report.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <ostream>

#include "app/cli/shell_word.hpp"
#include "app/cli/streams.hpp"
#include "app/report/page_template.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/output_file.hpp"

namespace chainreel {
namespace {

const char* class_of(const ReportPicture& picture) {
  return picture.passes ? "good" : "bad";
}

// What failed before what is good; within these by state, states in the order in which they come first.
std::vector<const ReportPicture*> in_order(const VerifyReport& report) {
  std::map<std::pair<bool, std::string>, std::size_t> first;
  std::vector<const ReportPicture*> pictures;
  for (std::size_t i = 0; i < report.pictures.size(); ++i) {
    const ReportPicture& picture = report.pictures[i];
    first.try_emplace({picture.passes, picture.state}, i);
    pictures.push_back(&picture);
  }
  std::stable_sort(pictures.begin(), pictures.end(), [&](const ReportPicture* a, const ReportPicture* b) {
    return std::pair(a->passes, first.at({a->passes, a->state})) <
           std::pair(b->passes, first.at({b->passes, b->state}));
  });
  return pictures;
}

std::string summary_line(const VerifyReport& report) {
  const std::size_t failed = std::size_t(std::count_if(report.pictures.begin(), report.pictures.end(),
                                                       [](const ReportPicture& p) { return !p.passes; }));
  const std::string all = std::to_string(report.pictures.size());
  if (failed == 0) return all + (report.pictures.size() == 1 ? " picture passed" : " pictures passed");
  return std::to_string(failed) + " of " + all +
         (report.pictures.size() == 1 ? " picture failed" : " pictures failed");
}

// What accepts one picture; "" where nothing can be accepted.
std::string accept_command_of(const VerifyReport& report, const ReportPicture& picture) {
  static const std::string kAccept = " --accept";
  const std::size_t at = report.accept_command.rfind(kAccept);
  if (picture.passes || picture.actual_png.empty() || at == std::string::npos) return "";
  return report.accept_command.substr(0, at + kAccept.size()) + " " + shell_word(picture.name);
}

std::string command_html(const std::string& command, const std::string& id) {
  if (command.empty()) return "";
  return filled_page(embedded_page("verify_accept.html"), {{"command", plain(command)}, {"id", plain(id)}});
}

std::string facts_of(const ReportPicture& picture) {
  std::vector<std::string> facts;
  if (!picture.source.empty()) facts.push_back(picture.source);
  if (!picture.expected_png.empty() && !picture.actual_png.empty())
    facts.push_back("worst error " + format_significant(picture.worst, 3) + ", " +
                    std::to_string(picture.beyond) + (picture.beyond == 1 ? " pixel" : " pixels") +
                    " beyond the tolerance");
  if (!picture.tolerance.empty()) facts.push_back("tolerance: " + picture.tolerance);
  return joined(facts, " \u00B7 ");
}

std::string words_html(const std::vector<std::string>& words) {
  if (words.empty()) return "";
  std::string html = "<ul>\n";
  for (const std::string& sentence : words) html += "<li>" + escape_html(sentence) + "</li>\n";
  return html + "</ul>\n";
}

// As texts of a kind that no browser runs or decodes. What is the same twice stands there once.
Filler images_of(const ReportPicture& picture, const std::string& id) {
  return [&picture, id](std::ostream& stream) {
    const auto write = [&](const char* kind, const std::string& bytes) {
      if (bytes.empty()) return;
      const bool same = bytes == picture.expected_png && &bytes != &picture.expected_png;
      stream << "<script type=\"text/plain\" id=\"" << kind << "-" << id << "\""
             << (same ? " data-as=\"expected\"" : "") << ">" << (same ? "" : base64(bytes)) << "</script>\n";
    };
    write("expected", picture.expected_png);
    write("actual", picture.actual_png);
    write("difference", picture.difference_png);
  };
}

std::string search_words(const ReportPicture& picture) {
  return picture.name + " " + picture.source + " " + picture.state + " " + joined(picture.words, " ");
}

std::string chips_html(const std::vector<const ReportPicture*>& pictures) {
  std::vector<std::string> states;
  std::map<std::string, int> counts;
  std::map<std::string, bool> good;
  for (const ReportPicture* picture : pictures) {
    if (counts[picture->state]++ == 0) {
      states.push_back(picture->state);
      good[picture->state] = true;
    }
    good[picture->state] = good[picture->state] && picture->passes;
  }
  std::string html;
  for (const std::string& state : states)
    html +=
        filled_page(embedded_page("verify_chip.html"), {{"state", plain(state)},
                                                        {"count", plain(std::to_string(counts[state]))},
                                                        {"verdict", plain(good[state] ? "good" : "bad")}});
  return html;
}

void write_page(std::ostream& stream, const VerifyReport& report) {
  const std::vector<const ReportPicture*> pictures = in_order(report);
  const auto each = [&](const char* page, auto fillers) {
    return Filler([&pictures, page, fillers](std::ostream& out) {
      for (std::size_t i = 0; i < pictures.size(); ++i) {
        throw_if_interrupted();
        fill_page(out, embedded_page(page), fillers(*pictures[i], std::to_string(i + 1)));
      }
    });
  };
  const auto row = [](const ReportPicture& picture, const std::string& id) {
    return Fillers{{"id", plain(id)},
                   {"name", plain(picture.name)},
                   {"state", plain(picture.state)},
                   {"search", plain(search_words(picture))},
                   {"verdict", plain(class_of(picture))}};
  };
  const auto article = [&report](const ReportPicture& picture, const std::string& id) {
    return Fillers{{"id", plain(id)},
                   {"name", plain(picture.name)},
                   {"state", plain(picture.state)},
                   {"verdict", plain(class_of(picture))},
                   {"facts", plain(facts_of(picture))},
                   {"words", markup(words_html(picture.words))},
                   {"accept", markup(command_html(accept_command_of(report, picture), "accept-" + id))},
                   {"images", images_of(picture, id)}};
  };
  fill_page(stream, embedded_page("verify.html"),
            {{"suite", plain(report.suite)},
             {"program", plain(report.program)},
             {"summary", plain(summary_line(report))},
             {"unused", markup(report.unused.empty() ? "" : "<p>" + escape_html(report.unused) + "</p>\n")},
             {"count", plain(std::to_string(pictures.size()))},
             {"accept", markup(command_html(report.accept_command, "accept-all"))},
             {"chips", markup(chips_html(pictures))},
             {"rows", each("verify_row.html", row)},
             {"pictures", each("verify_picture.html", article)},
             {"style", markup(std::string(embedded_page("verify.css")))},
             {"script", markup(std::string(embedded_page("verify.js")))}});
}

}  // namespace

void write_html_report(const std::string& path, const VerifyReport& report, bool overwrite) {
  OutputFile output(path, overwrite);
  std::ofstream stream(output.temporary_path(), std::ios::binary);
  write_page(stream, report);
  stream.close();
  if (!stream) throw Error(ExitCode::file, "could not be written whole: is the disk full?", {output.path()});
  throw_if_interrupted();
  output.commit();
}

}  // namespace chainreel
