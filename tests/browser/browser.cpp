#include "browser/browser.hpp"

#include <curl/curl.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <regex>
#include <stdexcept>
#include <thread>

#include "encode/png.hpp"

namespace chainreel {
namespace {

constexpr const char* kRemedy =
    ": packages chromium and chromium-driver are needed, ./dev setup installs them";
constexpr double kDriverStarts_s = 20;
constexpr long kAnswer_s = 60;

std::size_t append(char* data, std::size_t size, std::size_t count, void* text) {
  static_cast<std::string*>(text)->append(data, size * count);
  return size * count;
}

std::string from_base64(const std::string& letters) {
  std::string bytes;
  unsigned buffer = 0;
  int bits = 0;
  for (const char c : letters) {
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                                             : -1;
    if (value < 0) continue;
    buffer = buffer << 6 | unsigned(value);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += char(buffer >> bits & 255);
  }
  return bytes;
}

}  // namespace

Browser::Browser() {
  start_driver();
  try {
    const Json options{{"args",
                        {"--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                         "--hide-scrollbars", "--no-first-run", "--disable-background-networking",
                         "--force-device-scale-factor=1", "--user-data-dir=" + folder_.file("profile")}}};
    const Json session =
        send("POST", "/session",
             {{"capabilities",
               {{"alwaysMatch",
                 {{"goog:chromeOptions", options}, {"goog:loggingPrefs", {{"browser", "ALL"}}}}}}}});
    session_ = session.at("sessionId").get<std::string>();
    in_session("POST", "/timeouts", {{"script", 20000}, {"pageLoad", 60000}});
  } catch (...) {
    stop_driver();
    throw;
  }
}

Browser::~Browser() {
  try {
    send("DELETE", "/session/" + session_);
  } catch (const std::exception&) {
    // The driver is gone already.
  }
  stop_driver();
}

// On a free port of the driver's choice, which it names in its first lines.
void Browser::start_driver() {
  const std::string log = folder_.write("driver.log", "");
  driver_ = fork();
  if (driver_ == 0) {
    const int file = ::open(log.c_str(), O_WRONLY | O_APPEND);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    execlp("chromedriver", "chromedriver", "--port=0", static_cast<char*>(nullptr));
    _exit(127);
  }
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(kDriverStarts_s);
  while (std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const std::string text = read_whole_file(log);
    static const std::regex started("started successfully on port ([0-9]+)");
    std::smatch match;
    if (std::regex_search(text, match, started)) {
      port_ = std::stoi(match[1]);
      return;
    }
    int status = 0;
    if (waitpid(driver_, &status, WNOHANG) == driver_) {
      driver_ = -1;
      throw std::runtime_error("chromedriver did not start" + std::string(kRemedy) + "\n" + text);
    }
  }
  stop_driver();
  throw std::runtime_error("chromedriver did not name its port" + std::string(kRemedy));
}

void Browser::stop_driver() {
  if (driver_ < 0) return;
  kill(driver_, SIGTERM);
  waitpid(driver_, nullptr, 0);
  driver_ = -1;
}

Json Browser::send(const char* method, const std::string& path, const Json& body) {
  const std::unique_ptr<CURL, decltype(&curl_easy_cleanup)> curl(curl_easy_init(), &curl_easy_cleanup);
  const std::unique_ptr<curl_slist, decltype(&curl_slist_free_all)> headers(
      curl_slist_append(nullptr, "Content-Type: application/json"), &curl_slist_free_all);
  const std::string url = "http://127.0.0.1:" + std::to_string(port_) + path, text = body.dump();
  std::string answer;
  curl_easy_setopt(curl.get(), CURLOPT_URL, url.c_str());
  curl_easy_setopt(curl.get(), CURLOPT_NOPROXY, "*");
  curl_easy_setopt(curl.get(), CURLOPT_CUSTOMREQUEST, method);
  curl_easy_setopt(curl.get(), CURLOPT_HTTPHEADER, headers.get());
  curl_easy_setopt(curl.get(), CURLOPT_TIMEOUT, kAnswer_s);
  curl_easy_setopt(curl.get(), CURLOPT_WRITEFUNCTION, &append);
  curl_easy_setopt(curl.get(), CURLOPT_WRITEDATA, &answer);
  if (std::string(method) == "POST") curl_easy_setopt(curl.get(), CURLOPT_POSTFIELDS, text.c_str());
  const CURLcode code = curl_easy_perform(curl.get());
  if (code != CURLE_OK)
    throw std::runtime_error("chromedriver does not answer: " + std::string(curl_easy_strerror(code)));
  const Json json = Json::parse(answer);
  const Json& value = json.at("value");
  if (value.is_object() && value.contains("error"))
    throw std::runtime_error(path + ": " + value["message"].get<std::string>() +
                             (session_.empty() ? kRemedy : ""));
  return value;
}

Json Browser::in_session(const char* method, const std::string& path, const Json& body) {
  return send(method, "/session/" + session_ + path, body);
}

void Browser::resize(int width, int height) {
  in_session(
      "POST", "/goog/cdp/execute",
      {{"cmd", "Emulation.setDeviceMetricsOverride"},
       {"params", {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}}}});
}

void Browser::prefer_dark(bool dark) {
  const Json feature{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}};
  in_session("POST", "/goog/cdp/execute",
             {{"cmd", "Emulation.setEmulatedMedia"}, {"params", {{"features", Json::array({feature})}}}});
}

void Browser::open(const std::string& url) {
  complaints();  // of the page before
  in_session("POST", "/url", {{"url", url}});
}

Json Browser::run(const std::string& body, const Json& arguments) {
  return in_session("POST", "/execute/sync", {{"script", body}, {"args", arguments}});
}

Json Browser::run_async(const std::string& body) {
  const std::string script = "const done = arguments[arguments.length - 1]; (async () => {" + body +
                             "})().then(done, (error) => done({failed: String(error)}));";
  const Json value = in_session("POST", "/execute/async", {{"script", script}, {"args", Json::array()}});
  if (value.is_object() && value.contains("failed"))
    throw std::runtime_error(value["failed"].get<std::string>());
  return value;
}

Image Browser::screenshot(const std::string& file) {
  const Json letters = in_session("GET", "/screenshot");
  std::ofstream(file, std::ios::binary) << from_base64(letters.get<std::string>());
  return read_png(file);
}

std::vector<std::string> Browser::complaints() {
  std::vector<std::string> found;
  for (const Json& entry : in_session("POST", "/se/log", {{"type", "browser"}}))
    if (entry["level"] == "SEVERE" || entry["level"] == "WARNING")
      found.push_back(entry["level"].get<std::string>() + ": " + entry["message"].get<std::string>());
  return found;
}

}  // namespace chainreel
