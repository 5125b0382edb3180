// What the benchmarks measured, as CSV below tests/bench/results: lines that begin with # say on which
// machine, by which compiler and at which load; then a heading and a row each.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace chainreel::bench {

using Facts = std::vector<std::pair<std::string, std::string>>;

// Date, revision, processor, cores, load, system, compiler.
Facts machine_facts();

double median_of(std::vector<double> values);

double processor_seconds();  // of this process

// Of a program: 0, or 1 with what was thrown on standard error.
int run_main(void (*run)());

class Results {
 public:
  Results(std::string name, std::vector<std::string> columns);

  void note(std::string what, std::string value) { facts_.emplace_back(std::move(what), std::move(value)); }
  void add(std::vector<std::string> row);

  // Writes the file and says where; throws where it cannot be written.
  void write() const;

 private:
  std::string name_;
  Facts facts_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace chainreel::bench
