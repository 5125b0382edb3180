#include "browser/page_check.hpp"

#include <algorithm>
#include <cmath>

namespace chainreel {
namespace {

// Each film waits until it can show a frame (HAVE_CURRENT_DATA), fails, or has had five seconds.
constexpr const char* kLoad = R"js(
  const later = (ms) => new Promise((go) => setTimeout(go, ms));
  return Promise.all([...document.querySelectorAll('video')].map(async (video) => {
    for (let waited = 0; waited < 5000 && video.readyState < 2 && !video.error; waited += 50) await later(50);
    return {ready: video.readyState, error: video.error ? video.error.message : '', seconds: video.duration || 0,
            width: video.videoWidth, height: video.videoHeight, autoplay: video.autoplay, paused: video.paused};
  }));
)js";

// One after the other, until a fifth of a second has been played.
constexpr const char* kPlay = R"js(
  const later = (ms) => new Promise((go) => setTimeout(go, ms));
  const reached = [];
  for (const video of document.querySelectorAll('video')) {
    try { await video.play(); } catch (error) { reached.push(-1); continue; }
    for (let waited = 0; waited < 4000 && video.currentTime < 0.2; waited += 50) await later(50);
    reached.push(video.currentTime);
    video.pause();
    video.currentTime = 0;
  }
  return reached;
)js";

}  // namespace

std::vector<std::string> problems_of_page(Browser& browser, const std::string& file,
                                          const std::vector<ExpectedFilm>& films) {
  std::vector<std::string> problems;
  browser.open("file://" + file);
  const Json loaded = browser.run_async(kLoad), played = browser.run_async(kPlay);
  if (loaded.size() != films.size())
    problems.push_back("there are " + std::to_string(loaded.size()) + " films, not " +
                       std::to_string(films.size()));
  for (std::size_t i = 0; i < std::min(loaded.size(), films.size()); ++i) {
    const Json& film = loaded[i];
    const auto say = [&](const std::string& what) {
      problems.push_back("film " + std::to_string(i + 1) + ": " + what + " " + film.dump());
    };
    if (film["ready"].get<int>() < 2) say("does not load");
    if (film["autoplay"].get<bool>() || !film["paused"].get<bool>()) say("plays without being asked");
    if (film["width"] != films[i].width || film["height"] != films[i].height) say("has another size");
    if (std::abs(film["seconds"].get<double>() - films[i].seconds) > films[i].frame)
      say("has another duration");
    if (played[i].get<double>() < 0.2) say("does not play");
  }
  const Json asked = browser.run(
      "return performance.getEntriesByType('resource').map((e) => e.name).filter((n) => "
      "!n.startsWith('data:'))");
  for (const Json& url : asked) problems.push_back("asks for " + url.get<std::string>());
  for (const std::string& complaint : browser.complaints()) problems.push_back(complaint);
  return problems;
}

}  // namespace chainreel
