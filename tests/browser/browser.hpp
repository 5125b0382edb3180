// Chromium without a display, driven through chromedriver: the W3C's WebDriver protocol, JSON over HTTP.
#pragma once

#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/json.hpp"
#include "support/temporary_folder.hpp"

namespace chainreel {

class Browser {
 public:
  // Throws std::runtime_error with the remedy where Chromium or its driver is missing or does not start.
  Browser();
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  // The size of the page's window in CSS pixels; as a phone of that width would show it.
  void resize(int width, int height);
  void prefer_dark(bool dark);

  void open(const std::string& url);  // returns when the page has loaded
  // The body of a function of `arguments`; what it returns. In the second form it awaits promises, for up to
  // 20 s.
  Json run(const std::string& body, const Json& arguments = Json::array());
  Json run_async(const std::string& body);
  Image screenshot(const std::string& file);  // kept as `file`, too
  // What the console has said since the last call: warnings and errors, also those of the security policy.
  std::vector<std::string> complaints();

 private:
  void start_driver();
  void stop_driver();
  Json send(const char* method, const std::string& path, const Json& body = Json::object());
  Json in_session(const char* method, const std::string& path, const Json& body = Json::object());

  TemporaryFolder folder_;  // the browser's profile
  int driver_ = -1;         // process
  int port_ = 0;
  std::string session_;
};

}  // namespace chainreel
