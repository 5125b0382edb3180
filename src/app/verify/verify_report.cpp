#include "app/verify/verify_report.hpp"

#include <algorithm>
#include <fstream>

#include "app/cli/shell_word.hpp"
#include "app/report/junit.hpp"
#include "core/format.hpp"

namespace chainreel {
namespace {

// By which reports are known as ours.
const char* const kAccepted = "Pictures as accepted";
const char* const kChanged = "Pictures changed";

std::string plain(const PictureState state) {
  return to_string(state);
}

// Words of others must not become markup.
std::string markdown_words(const std::string& words) {
  std::string text;
  for (const char c : printable(words)) {
    if (c == '\n' || c == '\r')
      text += ' ';
    else if (std::string("\\`*_{}[]<>|#&").find(c) != std::string::npos)
      text += std::string("\\") + c;
    else
      text += c;
  }
  return text;
}

// As it stands, between fences longer than any in it.
std::string markdown_code(const std::string& text) {
  std::string fence = "```";
  while (text.find(fence) != std::string::npos) fence += '`';
  return fence + "sh\n" + printable(text) + "\n" + fence + "\n";
}

}  // namespace

int SuiteResult::failed() const {
  return int(
      std::count_if(pictures.begin(), pictures.end(), [](const PictureVerdict& one) { return !one.passes; }));
}

int SuiteResult::count(PictureState state) const {
  return int(std::count_if(pictures.begin(), pictures.end(),
                           [&](const PictureVerdict& one) { return one.state == state; }));
}

std::string accept_command(const SuiteResult& result) {
  if (result.failed() == result.count(PictureState::failed)) return "";
  const std::string suite = result.suite.starts_with('-') ? "./" + result.suite : result.suite;  // no option
  std::string command = "chainreel verify " + shell_word(suite) + " --accept";
  for (const PictureVerdict& one : result.pictures)
    if (!one.passes && one.state != PictureState::failed) command += " " + shell_word(one.name);
  return command;
}

std::string unused_words(const SuiteResult& result) {
  if (result.unused.empty()) return "";
  return "of no picture any more: " + std::string(result.unused.size() == 1 ? "the baseline " : "the baselines ") + joined(result.unused) +
         "; --prune removes " + (result.unused.size() == 1 ? "it" : "them");
}

std::string summary_of(const SuiteResult& result) {
  const int failed = result.failed(), all = int(result.pictures.size());
  std::vector<std::string> bad, good;  // what failed is told first
  for (std::size_t i = 0; i < names_of(PictureState{}).size(); ++i) {
    const int count = result.count(PictureState(i));
    if (count == 0) continue;
    // Other physics, say, that the suite lets pass.
    const auto passes = std::count_if(result.pictures.begin(), result.pictures.end(),
                                      [&](const PictureVerdict& one) { return one.state == PictureState(i) && one.passes; });
    (passes < count ? bad : good).push_back(std::to_string(count) + " " + to_string(PictureState(i)) +
                    (failed > 0 && passes > 0 && PictureState(i) != PictureState::same && PictureState(i) != PictureState::accepted
                         ? " (" + std::to_string(passes) + (passes == 1 ? " of them passes)" : " of them pass)")
                         : ""));
  }
  return (failed == 0 ? std::to_string(all) + (all == 1 ? " picture passed" : " pictures passed")
                      : std::to_string(failed) + " of " + std::to_string(all) + " pictures failed") +
         ": " + joined(bad) + (bad.empty() || good.empty() ? "" : "; the others: ") + joined(good);
}

Json to_json(const SuiteResult& result) {
  Json json{{"suite", result.suite},     {"baselines", result.baselines}, {"passed", result.failed() == 0},
            {"failed", result.failed()}, {"pictures", Json::array()},     {"unused", result.unused},
            {"pruned", result.pruned},    {"notices", result.notices}};
  for (const PictureVerdict& one : result.pictures) {
    Json picture{{"name", one.name},     {"source", one.source}, {"state", plain(one.state)},
                 {"passed", one.passes}, {"words", one.words},   {"tolerance", one.tolerance}};
    const ImageDifference& d = one.difference;
    picture["pixels"] = {{"unequal", d.unequal}, {"at_edges", d.at_edges},
                         {"beyond", d.beyond},   {"worst", d.worst},
                         {"mean", d.mean},       {"box", {d.box.x, d.box.y, d.box.width, d.box.height}}};
    json["pictures"].push_back(std::move(picture));
  }
  const std::string accept = accept_command(result);
  json["accept"] = accept.empty() ? Json(nullptr) : Json(accept);
  return json;
}

std::string junit_text(const SuiteResult& result) {
  std::vector<JunitCase> cases;
  for (const PictureVerdict& one : result.pictures) {
    JunitCase found{.group = one.source, .name = one.name, .is_error = one.state == PictureState::failed};
    if (!one.passes) {
      found.fault = plain(one.state);
      found.message = one.words.empty() ? "" : one.words.front();
      found.text = joined(one.words, "\n") + "\ntolerance: " + one.tolerance;
    }
    cases.push_back(found);
  }
  return junit_text("verify", result.suite, cases);
}

std::string markdown_text(const SuiteResult& result) {
  std::string text = "## " + std::string(result.failed() == 0 ? kAccepted : kChanged) +
                     ": " + markdown_words(result.suite) + "\n\n" + summary_of(result) + "\n";
  if (const std::string unused = unused_words(result); !unused.empty()) text += "\n" + markdown_words(unused) + "\n";
  if (result.failed() == 0) return text;
  text += "\n| picture | state | why |\n| --- | --- | --- |\n";
  SaidOnce said;
  for (const PictureVerdict& one : result.pictures)
    if (!one.passes)
      text += "| " + markdown_words(one.name) + " | " + plain(one.state) + " | " +
              markdown_words(joined(said.words_of(one), "; ")) + " |\n";
  const std::string accept = accept_command(result);
  return accept.empty() ? text : text + "\nTo take what is drawn now:\n\n" + markdown_code(accept);
}

bool is_own_report(const std::string& path) {
  constexpr std::size_t kHead = 1024;  // bytes: all marks stand in front
  std::string head(kHead, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), std::streamsize(head.size()));
  head.resize(std::size_t(file.gcount()));
  const auto holds = [&](const std::string& words) { return head.find(words) != std::string::npos; };
  return is_own_junit(head) || head.starts_with("## " + std::string(kAccepted) + ": ") ||
         head.starts_with("## " + std::string(kChanged) + ": ") || (holds("<!DOCTYPE html>") && holds("content=\"chainreel ") && holds(" verify\">"));
}

}  // namespace chainreel
