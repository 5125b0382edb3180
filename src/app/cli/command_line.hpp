// The command line's words: subcommands, their options and flags. CLI11 reads them, behind one unit: its headers
// cost more to compile than any command.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace chainreel {

// An option of a command, to say more of it where it is added.
class Option {
 public:
  explicit Option(void* option) : option_(option) {}

  Option required();
  Option range(int least, int most);
  Option positive();
  Option one_of(std::vector<std::string> words);
  Option show_default();  // in the help
  // A scene or model: one that comes with the program may be meant by its name alone; "-" is a scene that comes by standard
  // input. What it throws passes through run(). `ending`: what a bare name of no scene may lack, rr of rr.urdf.
  Option names_input(const std::string& ending = "");
  bool given() const;     // on the command line; to be asked when it was parsed

 private:
  void* option_;
};

// What was added is filled in when the command line is parsed: targets must outlive it. Names as in "-o,--output";
// without a dash the option is known by its place.
class Command {
 public:
  explicit Command(void* command) : command_(command) {}

  Option add_option(const std::string& name, std::string& target, const std::string& help);
  Option add_option(const std::string& name, int& target, const std::string& help);
  Option add_option(const std::string& name, double& target, const std::string& help);
  Option add_option(const std::string& name, std::vector<std::string>& target, const std::string& help);
  // Takes one argument each time it stands there, and never swallows what follows.
  Option add_repeatable(const std::string& name, std::vector<std::string>& target, const std::string& help);
  // Takes as many arguments as follow it, none among them.
  Option add_names(const std::string& name, std::vector<std::string>& target, const std::string& help);
  Option add_flag(const std::string& name, bool& target, const std::string& help);
  void footer(const std::string& text);
  void callback(std::function<void()> run);

  // What was given to the command, as words that say it again: what is found out by default, where the result goes,
  // how much is told and by how many threads are left out.
  std::vector<std::string> words() const;
  // Indices of those words that name files: what is known by its place, and what is meant as such.
  std::vector<std::size_t> files() const;

 private:
  struct Word {
    std::string text;
    bool is_file = false;
  };
  std::vector<Word> all_words() const;

  void* command_;
};

class CommandLine {
 public:
  CommandLine(const std::string& name, const std::string& about, const std::string& version,
              const std::string& footer);
  ~CommandLine();

  Command* add_subcommand(const std::string& name, const std::string& about);

  // A choice for all subcommands, before or behind their names, or by a variable of the environment. `take` is given one
  // of the words, before the subcommand runs.
  void add_choice(const std::string& name, const std::string& variable, std::vector<std::string> words,
                  const std::string& help, std::function<void(const std::string&)> take);

  struct CommandText {
    std::string name, about, help;
  };
  // What all subcommands say of themselves, in the order in which they were added.
  std::vector<CommandText> texts() const;

  // The same as a table, for manual pages and for shells that complete words.
  struct OptionTable {
    std::vector<std::string> names;  // "-o", "--output"; of what is known by its place, what the help calls it
    std::string help;
    std::vector<std::string> words;  // that it takes, where it takes only some
    bool takes_value = false;
    bool is_positional = false;
    bool is_required = false;
    const std::string& long_name() const { return names.back(); }
  };
  struct CommandTable {
    std::string name, about, footer;
    std::vector<OptionTable> options;
  };
  std::vector<CommandTable> tables() const;
  // What the program itself is called, and the options that all commands take.
  CommandTable shared_options() const;

  // Runs the subcommand. Returns the exit code; what the callback throws passes through.
  int run(int argc, char** argv);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace chainreel
