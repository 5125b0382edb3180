#include "app/report/junit.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/output_file.hpp"

namespace chainreel {
namespace {

const std::string kOfProgram = "chainreel ";

}  // namespace

std::string junit_text(const std::string& command, const std::string& suite, const std::vector<JunitCase>& cases) {
  const auto count = [&](bool errors) { return int(std::ranges::count_if(cases, [&](const JunitCase& one) { return !one.fault.empty() && one.is_error == errors; })); };
  tinyxml2::XMLPrinter printer;
  printer.PushHeader(false, true);
  printer.OpenElement("testsuites");
  printer.PushAttribute("name", (kOfProgram + command).c_str());
  printer.OpenElement("testsuite");
  printer.PushAttribute("name", printable(suite).c_str());
  printer.PushAttribute("tests", int(cases.size()));
  printer.PushAttribute("failures", count(false));
  printer.PushAttribute("errors", count(true));
  for (const JunitCase& one : cases) {
    printer.OpenElement("testcase");
    printer.PushAttribute("classname", one.group.c_str());
    printer.PushAttribute("name", one.name.c_str());
    if (!one.fault.empty()) {
      printer.OpenElement(one.is_error ? "error" : "failure");
      printer.PushAttribute("type", one.fault.c_str());
      printer.PushAttribute("message", printable(one.message).c_str());
      printer.PushText(printable(one.text).c_str());
      printer.CloseElement();
    }
    printer.CloseElement();
  }
  printer.CloseElement();
  printer.CloseElement();
  return printer.CStr();
}

bool is_own_junit(const std::string& head) {
  return head.find("<testsuites name=\"" + kOfProgram) != std::string::npos;
}

void write_junit(const std::string& path, const std::string& text) {
  constexpr std::streamsize kHead = 512;
  std::string head(std::size_t(kHead), '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), kHead);
  head.resize(std::size_t(std::max<std::streamsize>(file.gcount(), 0)));
  std::error_code code;
  if (std::filesystem::exists(path, code) && !is_own_junit(head)) throw Error(ExitCode::file, "exists already, and is no JUnit of this program: name another file", {path});
  write_text_file(path, text, true);
}

}  // namespace chainreel
