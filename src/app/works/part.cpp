#include "app/works/part.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "encode/library_versions.hpp"
#include "render/canvas.hpp"

namespace chainreel {
namespace {

std::optional<int> whole_number(const std::string& text) {
  int number = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (code != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

// Two numbers around a sign.
std::optional<std::pair<int, int>> two_numbers(const std::string& text, char sign) {
  const std::size_t at = text.find(sign);
  if (at == std::string::npos) return std::nullopt;
  const auto first = whole_number(text.substr(0, at)), second = whole_number(text.substr(at + 1));
  if (!first || !second) return std::nullopt;
  return std::pair{*first, *second};
}

int of_environment(const char* name, std::optional<int> otherwise) {
  const char* text = std::getenv(name);
  if (text == nullptr && otherwise) return *otherwise;
  const auto number = text == nullptr ? std::nullopt : whole_number(text);
  if (!number)
    throw Error(ExitCode::usage, std::string("--shard slurm: ") + name + " is " +
                                     (text == nullptr ? "not set" : "'" + std::string(text) + "'") +
                                     ": it is for tasks of an array job (sbatch --array=1-8); elsewhere say --shard k/n");
  return *number;
}

std::string six_digits(int number) {
  const std::string digits = std::to_string(number);
  return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits;
}

}  // namespace

PartRequest PartRequest::of_frames(const std::string& text) {
  const auto numbers = two_numbers(text, ':');
  if (!numbers || numbers->first >= numbers->second)
    throw Error(ExitCode::usage, "--frames takes the first frame and the one behind the last, like 0:150; not '" + text + "'");
  PartRequest request;
  request.first_ = numbers->first;
  request.second_ = numbers->second;
  return request;
}

PartRequest PartRequest::of_shard(const std::string& text) {
  PartRequest request;
  request.is_shard_ = true;
  if (text == "slurm") {
    const int least = of_environment("SLURM_ARRAY_TASK_MIN", 1), step = of_environment("SLURM_ARRAY_TASK_STEP", 1);
    request.first_ = (of_environment("SLURM_ARRAY_TASK_ID", {}) - least) / std::max(1, step) + 1;
    request.second_ = of_environment("SLURM_ARRAY_TASK_COUNT", {});
  } else if (const auto numbers = two_numbers(text, '/')) {
    request.first_ = numbers->first;
    request.second_ = numbers->second;
  }
  if (request.first_ < 1 || request.first_ > request.second_)
    throw Error(ExitCode::usage, "--shard takes which share of how many, like 1/8 to 8/8, or slurm; not '" + text + "'" +
                                     (text == "slurm" ? " with task " + std::to_string(request.first_) + " of " +
                                                            std::to_string(request.second_) +
                                                            ": of an array whose numbers have gaps, say --shard k/n"
                                                      : ""));
  return request;
}

std::string PartRequest::suffix() const {
  return is_shard_ ? ".part-" + std::to_string(first_) + "-of-" + std::to_string(second_)
                   : ".part-" + six_digits(first_) + "-" + six_digits(second_);
}

std::string PartRequest::text() const {
  return is_shard_ ? "shard " + std::to_string(first_) + "/" + std::to_string(second_)
                   : "frames " + std::to_string(first_) + ":" + std::to_string(second_);
}

FrameRange PartRequest::of_things(int count) const {
  const auto bound = [&](int k) { return int(std::int64_t(count) * k / second_); };
  return {bound(first_ - 1), bound(first_)};
}

FrameRange PartRequest::of(const std::vector<int>& bounds, bool is_fixed) const {
  if (is_shard_) {
    const FrameRange chunks = of_things(int(bounds.size()) - 1);
    return {bounds[std::size_t(chunks.first)], bounds[std::size_t(chunks.behind)]};
  }
  if (second_ > bounds.back())
    throw Error(ExitCode::usage,
                "--" + text() + ": the film has " + std::to_string(bounds.back()) + " frames, from 0 on");
  for (const int frame : {first_, second_}) {
    const auto next = std::lower_bound(bounds.begin(), bounds.end(), frame);
    if (!is_fixed || *next == frame) continue;
    throw Error(ExitCode::usage, "--" + text() + ": parts that can be joined begin and end with chunks of the film; nearest to " +
                                     std::to_string(frame) + " are " + std::to_string(*(next - 1)) + " and " +
                                     std::to_string(*next));
  }
  return {first_, second_};
}

Json to_json(const PartFacts& part) {
  const VideoSettings& s = part.settings;
  return {{"frames", {part.range.first, part.range.behind, part.frames}},
          {"size", {s.width, s.height}},
          {"fps", {s.fps.num, s.fps.den}},
          {"crf", s.crf ? Json(*s.crf) : Json(nullptr)},
          {"alpha", s.alpha},
          {"film_sha256", part.film_sha256},
          {"program", part.program},
          {"libraries", part.libraries},
          {"audit", part.audit},
          {"words", part.words},
          {"captions", part.captions}};
}

namespace {

constexpr std::string_view kSeal = "chainreel part ";
constexpr std::size_t kSealSize = kSeal.size() + 64;  // bytes, with the hash's digits

// MP4's and MOV's `free`, Matroska's Void.
std::string head_of_box(const std::string& path) {
  static_assert(kSealSize < 127);
  if (lower_case_ending(path) == ".webm") return {char(0xEC), char(0x80 | kSealSize)};
  return std::string(3, '\0') + char(8 + kSealSize) + "free";
}

// Of the first `size` bytes; "" where they cannot be read.
std::string hash_of_first(const std::string& path, std::uintmax_t size) {
  std::ifstream stream(path, std::ios::binary);
  Sha256 hash;
  std::vector<char> bytes(1 << 20);
  while (size > 0) {
    const auto count = std::streamsize(std::min<std::uintmax_t>(size, bytes.size()));
    if (!stream.read(bytes.data(), count)) return "";
    hash.add(std::as_bytes(std::span(bytes).first(std::size_t(count))));
    size -= std::uintmax_t(count);
  }
  return hash.finish();
}

}  // namespace

void seal_part(const std::string& path, const std::string& target) {
  const std::string hash = sha256_of_file(path);
  std::ofstream stream(path, std::ios::binary | std::ios::app);
  stream << head_of_box(path) << kSeal << hash;
  stream.close();
  if (!stream) throw Error(ExitCode::file, "could not be written whole: is the disk full?", {target});
}

void require_sealed(const std::string& path) {
  std::error_code code;
  const std::uintmax_t size = std::filesystem::file_size(path, code), box = head_of_box(path).size() + kSealSize;
  std::string seal(kSealSize, '\0');
  std::ifstream stream(path, std::ios::binary);
  if (code || size < box || !stream.seekg(std::streamoff(size - kSealSize)) || !stream.read(seal.data(), std::streamsize(kSealSize)) ||
      seal != std::string(kSeal) + hash_of_first(path, size - box))
    throw Error(ExitCode::bad_input, "is not as it was written: it has been changed or cut off since; render it anew", {path});
}

PartFacts part_facts(const std::string& text, const std::string& path) {
  if (text.empty())
    throw Error(ExitCode::bad_input, "is no part of a film: such are written by `chainreel render --frames` or `--shard`", {path});
  PartFacts part;
  try {
    const Json json = parse_json(text);
    part.range = {json.at("frames").at(0).get<int>(), json.at("frames").at(1).get<int>()};
    part.frames = json.at("frames").at(2).get<int>();
    VideoSettings& s = part.settings;
    s.width = json.at("size").at(0).get<int>();
    s.height = json.at("size").at(1).get<int>();
    s.fps = {json.at("fps").at(0).get<int>(), json.at("fps").at(1).get<int>()};
    if (!json.at("crf").is_null()) s.crf = json.at("crf").get<double>();
    s.alpha = json.at("alpha").get<bool>();
    part.film_sha256 = json.at("film_sha256").get<std::string>();
    part.program = json.at("program").get<std::string>();
    part.libraries = json.at("libraries").get<std::vector<std::string>>();
    part.audit = json.at("audit");
    part.words = json.at("words").get<std::string>();
    part.captions = json.at("captions").get<std::string>();
  } catch (const Json::exception&) {
    throw Error(ExitCode::bad_input, "what it tells of itself as a part of a film is spoilt", {path});
  }
  const bool good = part.range.first >= 0 && !part.range.empty() && part.range.behind <= part.frames &&
                    part.settings.fps.num > 0 && part.settings.fps.den > 0 && part.audit.is_object();
  if (!good) throw Error(ExitCode::bad_input, "what it tells of itself as a part of a film is spoilt", {path});
  return part;
}

std::string meshes_hash(const PreparedFilm& film) {
  Sha256 hash;
  const auto add = [&hash](const auto& values) { hash.add(std::as_bytes(std::span(values))); };
  bool has_some = false;
  for (const PreparedScene& panel : film.panels) {
    if (!panel.shapes) continue;
    for (const BodyShape& shape : panel.shapes->shapes) {
      has_some = true;
      add(shape.mesh->vertices);
      add(shape.mesh->triangles);
    }
  }
  return has_some ? hash.finish() : "";
}

std::vector<std::string> libraries_behind(const Fonts& fonts) {
  std::vector<std::string> libraries = encoder_builds();
  const RendererInfo info = Canvas(16, 16, fonts).info();
  libraries.push_back(info.renderer + ", OpenGL " + info.version);  // alike whichever library brings it
  return libraries;
}

bool are_alike(const std::vector<std::string>& libraries, const std::vector<std::string>& others) {
  const auto [mine, theirs] = std::ranges::mismatch(libraries, others);
  if (mine == libraries.end() && theirs == others.end()) return true;
  if (mine != std::prev(libraries.end()) || theirs != std::prev(others.end())) return false;
  const auto is_without = [](const std::string& renderer) { return renderer == "chainreel, OpenGL none"; };
  const auto is_pinned = [&](const std::string& renderer) { return is_without(renderer) || renderer.starts_with("llvmpipe"); };
  return (is_without(*mine) || is_without(*theirs)) && is_pinned(*mine) && is_pinned(*theirs);
}

std::string film_hash(const ClipMemory& memory, const Fonts& fonts) {
  Sha256 hash;
  const auto add = [&hash](const auto& values) { hash.add(std::as_bytes(std::span(values))); };
  add(memory.scene);
  add(memory.audit.dump());
  for (const Face face : {Face::label, Face::label_bold, Face::math}) add(fonts.sha256(face));
  for (const Face face : fonts.fallbacks()) add(fonts.sha256(face) + std::to_string(fonts.index(face)));
  return hash.finish();
}

}  // namespace chainreel
