// chainreel methods: the registry of methods, a row each.

#include <cstdio>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/guide/reference.hpp"
#include "app/report/report.hpp"
#include "core/json.hpp"
#include "integrate/method.hpp"

namespace chainreel {
namespace {

Json to_json(const Method& method) {
  Json json{{"name", method.name},
            {"order", method.order},
            {"kind", method.kind},
            {"state", state_words(method)},
            {"dense_order", method.dense_order},
            {"adaptive", method.adaptive},
            {"symplectic", method.symplectic},
            {"reversible", method.reversible},
            {"source", method.source}};
  json["orders"] = nullptr;  // those that may be chosen
  if (method.highest_order > 0) json["orders"] = {method.lowest_order, method.highest_order};
  return json;
}

void run_methods(const CommonOptions& options) {
  Json list = Json::array();
  std::vector<std::vector<std::string>> table{{"name", "order", "dense", "state", "step", "kind", "source"}};
  for (const Method& method : methods()) {
    list.push_back(to_json(method));
    table.push_back({method.name, order_words(method), std::to_string(method.dense_order),
                     state_words(method), method.adaptive ? "adaptive or fixed" : "fixed", method.kind,
                     method.source});
  }
  tell_result(options, [&] { return Json{{"methods", list}}; }, [&] { std::fputs(table_text(table).c_str(), stdout); });
}

}  // namespace

void add_methods_command(CommandLine& app) {
  auto options = std::make_shared<CommonOptions>();
  Command* command = app.add_subcommand("methods", "the integrators: order, kind and source of each");
  add_json_option(*command, *options);
  command->footer("Example: chainreel methods --json");
  command->callback([options] { run_methods(*options); });
}

}  // namespace chainreel
