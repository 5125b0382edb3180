// Charts as files: what several commands that draw one share.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "app/cli/command.hpp"
#include "app/film/clip_memory.hpp"
#include "app/paper/paper.hpp"
#include "app/today/table_record.hpp"
#include "core/frame_rate.hpp"
#include "core/json.hpp"
#include "draw/charts/chart_page.hpp"
#include "integrate/method.hpp"
#include "picture/picture.hpp"
#include "picture/text.hpp"
#include "scene/scene.hpp"

namespace chainreel {

struct FigureOptions {
  bool is_one_of_several = false;  // that the command makes: by itself it is not to be made again, and remembers not what its files said
  std::vector<std::string> outputs;
  int width = 0, height = 0;  // 0: 1920 x 1080
  PaperOptions paper;
  const Command* command = nullptr;  // what it was given is remembered by the picture
};

// With the flags --theme and --text-scale: a chart has the look of its scene unless they say otherwise.
void add_figure_options(Command& command, FigureOptions& options, CommonOptions& common,
                        const std::string& default_output);

// Throws Error (usage) of a size that cannot be: before anything is measured.
void check_figure_size(const FigureOptions& options);

// Throws Error (usage) unless the ending is .png, .svg, .pdf or one of a table: .csv, .json, .npz.
void check_figure_path(const std::string& path);

// What a command found, for files without a picture: .csv as it is, .npz its columns, .json the report that --json prints.
struct FigureNumbers {
  std::string csv;
  std::function<Json()> report;
};
bool is_table_path(const std::string& path);
void write_numbers(const std::string& path, const FigureNumbers& numbers, bool overwrite);

ChartLook chart_look(const FigureOptions& options, const Scene& scene, const Fonts& fonts);

// What all pictures of a chart remember but their title, see memory_of_figure.
ClipMemory memory_of_chart(const FigureOptions& options);
// One of them, under its file's name as title.
void write_figure(const FigureOptions& options, const Picture& picture, const Fonts& fonts, ClipMemory memory, const std::string& path, bool overwrite);

// The files that -o names, or `usual`, checked before anything is measured: endings, doubles, and whether each may be written.
class FigureFiles {
 public:
  // Throws Error (usage) as check_figure_path does and for a path that is named twice, (file) where one may not be written.
  FigureFiles(const FigureOptions& options, const std::string& usual, bool overwrite);

  // Pictures as their endings say, and beside each the numbers as CSV, out/x.png and out/x.csv, where no other -o names that
  // file; tables alone. `draw` is called where a picture is asked for. Returns what was written.
  std::vector<std::string> write(const std::function<Picture()>& draw, const FigureNumbers& numbers, const Fonts& fonts);

 private:
  bool is_named(const std::string& path) const;

  const FigureOptions& options_;
  std::vector<std::string> paths_, beside_;  // beside_: tables that lie by pictures
  bool overwrite_;
  TableRecords records_;  // of tables that -o names
};

// What a figure remembers that shows no scene: the words that made it, what its files say (kInputs) where each can be read by itself, but of charts, which measure, and the model and its poses where there are.
ClipMemory memory_of_figure(const Command& command, const std::string& title);
ClipMemory memory_of_figure(const Command& command, const std::string& title, const std::string& model,
                            const std::vector<std::vector<double>>& poses);
// What poses were that have a name beside the model: "ready" and "joint1=0.1,joint2=0". In its figure as `named_poses`.
using NamedPoses = std::map<std::string, std::string>;
void remember_named_poses(ClipMemory& memory, const NamedPoses& poses);

// "rk4,taylor": rows of the registry; "" is all of them. Throws Error (usage) naming the option.
std::vector<const Method*> parse_methods(const std::string& text, const std::string& option = "--methods");
// The names of `--highlight`, which must be of methods that were chosen; none where nothing is asked for.
std::vector<std::string> parse_highlight(const std::string& text, const std::vector<const Method*>& chosen);

// Lines that begin with #: machine, compiler, version, scene.
std::string csv_facts(const std::string& scene);
// "Xeon 2.80GHz; g++ 12.2.0; chainreel 0.1.0, 1a2b3c4": for the foot of a chart.
std::string machine_line();

}  // namespace chainreel
