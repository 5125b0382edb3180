// chainreel join PART... -o FILM: parts of a film, rendered apart, become the whole without being encoded again.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "app/cli/command.hpp"
#include "app/cli/result.hpp"
#include "app/cli/streams.hpp"
#include "app/film/formats.hpp"
#include "app/report/sidecar.hpp"
#include "app/sweep/sweep_table.hpp"
#include "app/works/part.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"
#include "core/output_file.hpp"
#include "encode/film_chunk.hpp"
#include "encode/film_start.hpp"
#include "scene/text/scene_paths.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

struct JoinOptions {
  std::vector<std::string> parts;
  std::string output;
  CommonOptions common;
};

struct Part {
  std::string path;
  Tags tags;  // of the film, without what makes it a part
  PartFacts facts;
};

Part read_part(const std::string& path) {
  require_plain_file(path, kLargestInput * 64);
  note_input(path);
  Part part{path, read_film_tags(path), {}};
  part.facts = part_facts(part.tags[kPart], path);
  require_sealed(path);
  // Containers add some of their own.
  std::erase_if(part.tags, [](const auto& tag) {
    return tag.first == kPart || (!tag.first.starts_with("chainreel_") && tag.first != "title" && tag.first != "description");
  });
  return part;
}

// The first in the lists that is not the same.
std::string other_library(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const auto [mine, others] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  return (others == b.end() ? "nothing more" : *others) + ", not " + (mine == a.end() ? "nothing more" : *mine);
}

// What two parts of one film say alike, in the order in which it is worth telling.
void require_same_film(const Part& a, const Part& b) {
  const auto differ = [&](const std::string& what) {
    throw Error(ExitCode::bad_input, "is no part of the same film as " + a.path + ": " + what, {b.path});
  };
  const auto word = [](const Part& part, const char* key) { return part.facts.audit.value(key, Json()); };
  const auto without_place = [](Json audit) {  // parts may lie elsewhere beside the scene
    audit.erase(kScenePath);
    return audit;
  };
  const VideoSettings &s = a.facts.settings, &t = b.facts.settings;
  if (word(a, "model_sha256") != word(b, "model_sha256")) differ("its model is another one");
  if (word(a, "trajectory_sha256") != word(b, "trajectory_sha256")) differ("it shows another motion");
  if (a.facts.frames != b.facts.frames)
    differ("that film has " + std::to_string(b.facts.frames) + " frames, not " + std::to_string(a.facts.frames));
  if (s.width != t.width || s.height != t.height || !(s.fps == t.fps)) differ("its size or frame rate is another one");
  if (s.crf != t.crf || s.alpha != t.alpha) differ("its quality or opacity is another one");
  if (a.facts.program != b.facts.program)
    differ("it was rendered by chainreel " + b.facts.program + ", not " + a.facts.program);
  if (word(a, "versions") != word(b, "versions")) differ("it was rendered with other versions of libraries");
  if (!are_alike(a.facts.libraries, b.facts.libraries))
    differ("it was drawn or encoded by " + other_library(a.facts.libraries, b.facts.libraries));
  if (word(a, "style") != word(b, "style")) differ("its style's logo or font files are others");
  if (a.tags != b.tags) differ("its scene differs");
  if (word(a, kMeshesHash) != word(b, kMeshesHash)) differ("it was rendered with other meshes");
  if (a.facts.film_sha256 != b.facts.film_sha256) differ("it was rendered with other fonts");
  const Json one = without_place(a.facts.audit), other = without_place(b.facts.audit);
  if (one != other) differ("its audit differs in '" + Json::diff(one, other).front().value("path", "") + "'");
}

// The scene, where it lies from the first part that leads to it, as found from the folder of the joined film; else what the first says.
Json joined_scene_path(const std::vector<Part>& parts, const std::string& output) {
  for (const Part& part : parts) {
    const Json told = part.facts.audit.value(kScenePath, Json());
    if (!told.is_string() || fs::path(told.get<std::string>()).is_absolute()) continue;
    std::error_code code;
    const fs::path scene = fs::path(part.path).parent_path() / told.get<std::string>(), here = fs::current_path(code);
    if (fs::is_regular_file(scene, code))
      return path_from(fs::path(output).parent_path().string(), (here / scene).lexically_normal().lexically_proximate(here).string());
  }
  return parts.front().facts.audit.value(kScenePath, Json());
}

// In the order of the film, each frame once.
std::vector<Part> parts_of(const JoinOptions& options) {
  std::vector<Part> parts;
  for (const std::string& path : options.parts) parts.push_back(read_part(path));
  for (const Part& part : parts) require_same_film(parts.front(), part);
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.facts.range.first < b.facts.range.first; });
  std::vector<Problem> problems;
  const auto missing = [&](int first, int behind) {
    problems.push_back({"frames " + std::to_string(first) + " to " + std::to_string(behind - 1) + " of " +
                            std::to_string(parts.front().facts.frames) + " are missing: render them with --frames " +
                            std::to_string(first) + ":" + std::to_string(behind),
                        {options.output}});
  };
  int next = 0;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const FrameRange& range = parts[k].facts.range;
    if (range.first > next) missing(next, range.first);
    if (range.first < next)
      problems.push_back({"its frames from " + std::to_string(range.first) + " on are in " + parts[k - 1].path + ", too",
                          {parts[k].path}});
    next = std::max(next, range.behind);
  }
  if (next < parts.front().facts.frames) missing(next, parts.front().facts.frames);
  if (!problems.empty()) throw Error(ExitCode::bad_input, std::move(problems));
  return parts;
}

void copy_frames(const Part& part, PacketReader& reader, FilmWriter& writer) {
  const int frames = part.facts.range.behind - part.facts.range.first;
  const auto spoilt = [&part] {
    throw Error(ExitCode::bad_input, "does not hold the frames that it tells of", {part.path});
  };
  FilmPacket packet;
  int count = 0;
  for (; reader.next(packet); ++count) {
    throw_if_interrupted();
    if (count >= frames || packet.pts < 0 || packet.pts >= frames || (count == 0 && !packet.is_key)) spoilt();
    writer.add(packet);
  }
  if (count != frames) spoilt();
  writer.end_chunk(frames);
}

void write_film(const std::vector<Part>& parts, const std::string& path) {
  VideoSettings settings = parts.front().facts.settings;
  settings.tags = parts.front().tags;
  std::unique_ptr<FilmWriter> writer;
  std::string head;
  for (const Part& part : parts) {
    PacketReader reader(part.path, settings.fps);
    if (!writer) {
      settings.codec = reader.codec();
      if (const OutputFormat* format = find_output_format(part.path); format == nullptr || format->codec != settings.codec)
        throw Error(ExitCode::bad_input, "is not what its ending says: give it back the one that it was rendered with", {part.path});
      head = reader.head();
      writer = std::make_unique<FilmWriter>(path, settings, head);
    } else if (reader.codec() != settings.codec || reader.head() != head) {
      throw Error(ExitCode::bad_input, "is encoded in another way than " + parts.front().path, {part.path});
    }
    copy_frames(part, reader, *writer);
  }
  writer->finish();
}

struct JoinedFiles {
  OutputFile film, audit, words;
  std::unique_ptr<OutputFile> captions;
};

Json joined_json(const JoinOptions& options, Json frames, Json failed) {
  Json json = files_json({options.output});
  json.update({{"parts", options.parts.size()}, {"frames", std::move(frames)}, {"failed", std::move(failed)}});
  return json;
}

void run_join(const JoinOptions& options) {
  if (lower_case_ending(options.output) == ".csv") {
    const SweepOutcome outcome = join_tables(options.parts, options.output, options.common.force);
    tell_result(options.common,
                [&] { return joined_json(options, nullptr, outcome.failed); },
                [&] { std::printf("%s: the table of %zu parts\n", options.output.c_str(), options.parts.size()); });
    return require_none_failed(outcome, options.output);
  }
  if (lower_case_ending(options.parts.front()) == ".csv")
    throw Error(ExitCode::usage, "-o " + options.output + ": its parts are .csv tables, which are joined as one: name a .csv");
  const std::vector<Part> parts = parts_of(options);
  const PartFacts& facts = parts.front().facts;
  if (lower_case_ending(options.output) != lower_case_ending(parts.front().path))
    throw Error(ExitCode::usage, "-o " + options.output + ": its parts are " +
                                     fs::path(parts.front().path).extension().string() + " files, and joining encodes nothing");
  const bool force = options.common.force;
  std::string base = fs::path(audit_path_of(options.output)).replace_extension().string();
  OtherFiles others = others_audited(base + ".json", {options.output}, facts.audit);
  std::unique_ptr<OutputFile> shared;  // the audit of another film, which told of this file, too
  Json without_this;
  if (!others.are_others.empty()) {
    std::fprintf(stderr, "note: %s.json tells of %s, which shows something else: %s.json tells of this one\n", base.c_str(),
                 joined(others.are_others).c_str(), options.output.c_str());
    without_this = audit_without(base + ".json", {options.output});
    if (!without_this.is_null()) shared = std::make_unique<OutputFile>(base + ".json", force);
    base = options.output;
    others = {};
  }
  const auto beside = [&](const char* ending) {
    require_own_sidecar(base + ending, force);
    return base + ending;
  };
  JoinedFiles files{OutputFile(options.output, force), OutputFile(beside(".json"), force),
                    OutputFile(beside(".txt"), force), nullptr};
  if (!facts.captions.empty()) files.captions = std::make_unique<OutputFile>(beside(".srt"), force);

  write_film(parts, files.film.temporary_path());
  files.film.commit();
  Json audit = facts.audit;
  audit[kScenePath] = joined_scene_path(parts, options.output);
  Json film = audited_file(options.output);
  film.update(clip_facts(facts.settings.width, facts.settings.height, facts.settings.fps, facts.frames));
  audit[kAuditedFiles] = others.entries;
  audit[kAuditedFiles].push_back(std::move(film));
  audit[kSidecarHashes] = Json::object();
  write_whole(files.words, facts.words);
  audit[kSidecarHashes][".txt"] = sha256_of(facts.words);
  if (files.captions) {
    write_whole(*files.captions, facts.captions);
    audit[kSidecarHashes][".srt"] = sha256_of(facts.captions);
  }
  write_whole(files.audit, audit.dump(2) + "\n");
  if (shared) write_whole(*shared, without_this.dump(2) + "\n");
  tell_result(options.common,
              [&] { return joined_json(options, facts.frames, nullptr); },
              [&] { std::printf("%s: %d frames of %zu parts\n", options.output.c_str(), facts.frames, parts.size()); });
}

}  // namespace

void add_join_command(CommandLine& app) {
  auto options = std::make_shared<JoinOptions>();
  Command* command = app.add_subcommand("join", "one film, or table, of the parts that `render` and `sweep` wrote by --frames and --shard");
  command->add_option("parts", options->parts, "the parts, in any order").required();
  command->add_option("-o,--output", options->output, "the film or table, with the ending of its parts").required();
  add_result_options(*command, options->common);
  command->footer("Example: chainreel join out/film.part-*.mp4 -o out/film.mp4\n"
                  "of what  chainreel render rr_free -o out/film.mp4 --shard 1/2  and --shard 2/2 write");
  command->callback([options] { run_join(*options); });
}

}  // namespace chainreel
