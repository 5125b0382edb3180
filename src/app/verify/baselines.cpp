#include "app/verify/baselines.hpp"

#include <fcntl.h>
#include <linux/fs.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "app/cli/streams.hpp"
#include "core/error.hpp"
#include "core/format.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"
#include "encode/png.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestFacts = std::uintmax_t(64) << 20;  // bytes
constexpr const char* kRecords = "records";
constexpr const char* kCameraFile = "records/cameras.json";

// What the suite is called: FOLDER of FOLDER/ and of `.` within it.
fs::path path_of(const Suite& suite) {
  fs::path path = fs::path(suite.file).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();
  if (path.empty() || path.filename() == "." || path.filename() == "..") {
    path = fs::absolute(suite.file).lexically_normal();
    if (path.filename().empty()) path = path.parent_path();
  }
  return path;
}

// Beside a suite's file; of a folder by itself in it, where those of its snapshots.yaml would lie: what is under version control
// holds them.
std::string folder_of(const Suite& suite) {
  fs::path path = path_of(suite);
  if (fs::is_directory(path)) return (fs::path(suite.file) / "snapshots.baselines").lexically_normal().string();
  return path.replace_extension().string() + ".baselines";
}

// a.yaml and a.yml, or a folder and the snapshots.yaml in it, are two suites, whose baselines would lie in one folder: each knows
// its own.
std::string identity_of(const Suite& suite) {
  const fs::path path = path_of(suite);
  return fs::is_directory(path) ? "./" : printable(path.filename().string());  // a name may be no text; a folder may get another one
}

// A record of ours: 16 hexadecimal digits and .json.
bool is_record(const fs::path& path) {
  const std::string stem = path.stem().string();
  return path.extension() == ".json" && stem.size() == 16 &&
         stem.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::string facts_file_of(const std::string& name) {
  return name + ".json";
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
  throw Error(ExitCode::bad_input, why, {path.string()});
}

Json read_facts(const fs::path& path, const std::string& remedy) {
  Json facts = parse_json(read_plain_file(path.string(), kLargestFacts));
  if (!facts.is_object()) refuse(path, "is no JSON object: restore it, or " + remedy);
  return facts;
}

void write_whole_file(const fs::path& path, const std::string& bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  const bool good = file && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int code = errno;
  if (file && std::fclose(file) != 0) throw Error(ExitCode::file, std::strerror(errno), {path.string()});
  if (!good) throw Error(ExitCode::file, std::strerror(code), {path.string()});
}

std::string text_of(const Json& json) {
  return json.dump(1) + "\n";
}

// The records of physics stand apart: many pictures share them.
constexpr const char* kRecordKeys[] = {"model", "run"};

// What is not a plain file of ours has no business in the folder, and is not carried over in silence.
void copy_baselines(const fs::path& from, const fs::path& to) {
  std::error_code code;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(from)) {
    const fs::path target = to / entry.path().lexically_relative(from);
    if (entry.is_directory())
      fs::create_directory(target, code);
    else if (!entry.is_regular_file() || entry.is_symlink())
      refuse(entry.path(), "is no plain file: baselines are plain files alone; move it away");
    else if (fs::create_hard_link(entry.path(), target, code); code)
      fs::copy_file(entry.path(), target, code = {});
    if (code) throw Error(ExitCode::file, code.message(), {target.string()});
  }
}

}  // namespace

std::string picture_file_of(const std::string& name) {
  return name + ".png";
}

SuiteLock::SuiteLock(const Suite& suite, For purpose) {
  file_ = ::open(suite.file.c_str(), O_RDONLY | O_CLOEXEC);
  if (file_ < 0) throw Error(ExitCode::bad_input, std::strerror(errno), {suite.file});
  const int kind = purpose == For::writing ? LOCK_EX : LOCK_SH;
  for (bool told = false; ::flock(file_, kind | LOCK_NB) != 0; told = true) {
    if (errno == ENOSYS || errno == EOPNOTSUPP || errno == ENOLCK || errno == EINVAL) {
      if (purpose == For::writing)
        std::fprintf(stderr, "%s: this file system knows no locks: see to it that no other verify writes now\n",
                     suite.file.c_str());
      return;
    }
    if (errno != EWOULDBLOCK) {
      const int code = errno;
      ::close(file_);
      throw Error(ExitCode::file, std::string("cannot be locked: ") + std::strerror(code), {suite.file});
    }
    if (!told) std::fprintf(stderr, "%s: waiting for another verify of it\n", suite.file.c_str());
    ::usleep(50'000);
    if (interrupted()) {
      ::close(file_);
      throw_if_interrupted();
    }
  }
}

SuiteLock::~SuiteLock() {
  ::close(file_);
}

Baselines::Baselines(const Suite& suite) : folder_(folder_of(suite)), suite_(identity_of(suite)) {}

bool Baselines::exist() const {
  std::error_code code;
  return fs::is_directory(folder_, code);
}

std::set<std::string> Baselines::names() const {
  std::set<std::string> names;
  if (!exist()) return names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    if (entry.path().extension() != ".png") continue;
    const std::string name = entry.path().stem().string();
    const fs::path facts = fs::path(folder_) / facts_file_of(name);
    std::error_code code;
    if (!fs::is_regular_file(facts, code)) continue;
    const Json json = parse_json(read_plain_file(facts.string(), kLargestFacts));
    if (json.is_object() && json.value("suite", Json()) == Json(suite_) &&
        json.value("picture", Json()) == Json(name))
      names.insert(name);
  }
  return names;
}

bool Baselines::has(const std::string& name) const {
  std::error_code code;
  return fs::exists(fs::path(folder_) / picture_file_of(name), code);
}

Baseline Baselines::read(const std::string& name) const {
  const fs::path path = fs::path(folder_) / picture_file_of(name),
                 facts_path = fs::path(folder_) / facts_file_of(name);
  if (!fs::exists(facts_path))
    refuse(facts_path, "is missing beside the picture: restore it, or --accept " + name);
  const Json facts = read_facts(facts_path, "--accept " + name);
  if (facts.value("suite", Json()) != Json(suite_))
    refuse(path, "belongs to the suite " + facts.value("suite", Json("of another name")).dump() +
                     ", not to \"" + suite_ + "\": move it away, or --accept " + name);
  if (facts.value("picture", Json()) != Json(name))
    refuse(path, "is the picture " + facts.value("picture", Json("of another name")).dump() +
                     ": restore it, or --accept " + name);
  note_input(path.string());
  note_input(facts_path.string());
  Baseline baseline;
  baseline.png = read_plain_file(path.string());
  baseline.image = read_png(path.string());
  if (facts.value("png_sha256", Json()) != Json(sha256_of(baseline.png)))
    refuse(path, "was changed since it was accepted: restore it, or --accept " + name);
  baseline.page = facts.value("page", Json::object());
  baseline.physics = facts.value("physics", Json::object());
  for (const char* key : kRecordKeys) {
    if (!baseline.physics.contains(key)) continue;
    const Json id = baseline.physics[key];
    if (!id.is_string() || !is_record(id.get<std::string>() + ".json"))
      refuse(facts_path, "names no record: restore it, or --accept " + name);
    const fs::path record =
        fs::path(folder_) / kRecords / (id.is_string() ? id.get<std::string>() + ".json" : "?");
    const std::string text = read_plain_file(record.string(), kLargestFacts);
    if (Json(sha256_of(text).substr(0, 16)) != id)
      refuse(record, "was changed since it was accepted: restore it, or --accept " + name);
    baseline.physics[key] = parse_json(text);
  }
  return baseline;
}

std::string Baselines::camera_file() const {
  return (fs::path(folder_) / kCameraFile).string();
}

Cameras Baselines::cameras() const {
  const fs::path path = camera_file();
  Cameras cameras;
  if (!fs::exists(path)) return cameras;
  const std::string remedy = "take a new camera with --accept --refit";
  const Json facts = read_facts(path, remedy);
  for (const auto& [source, part] : facts.items()) {
    const bool are_numbers = part.is_array() && std::all_of(part.begin(), part.end(), [](const Json& one) { return one.is_number(); });
    const std::vector<double> numbers = are_numbers ? part.get<std::vector<double>>() : std::vector<double>{};
    const bool has_eye = numbers.size() == 8;
    if ((numbers.size() != 4 && !has_eye) || !(numbers[0] < numbers[2]) || !(numbers[1] < numbers[3]) || (has_eye && !(numbers[7] > 0)))
      refuse(path, "'" + source + "' must hold left, bottom, right and top of a camera, and of one with an eye where it looks and its distance: "
                       "restore it, or " + remedy);
    KeptCamera& camera = cameras[source];
    std::copy_n(numbers.begin(), 4, camera.part.begin());
    if (has_eye) std::copy_n(numbers.begin() + 4, 4, camera.eye.emplace().begin());
  }
  return cameras;
}

BaselineUpdate::BaselineUpdate(const Suite& suite, const Baselines& old)
    : folder_(old.folder()), suite_(identity_of(suite)) {
  const fs::path parent =
      fs::path(folder_).parent_path().empty() ? fs::path(".") : fs::path(folder_).parent_path();
  std::error_code code;
  if (fs::is_symlink(folder_, code))
    throw Error(ExitCode::file, "is a link, and baselines are exchanged as a whole folder: put the folder itself there",
                {folder_});
  if (fs::exists(fs::symlink_status(folder_, code)) && !fs::is_directory(fs::symlink_status(folder_, code)))
    throw Error(ExitCode::file, "is no folder, and baselines belong there: move it away", {folder_});
  remove_leftovers(parent.string());
  for (const fs::path& written : {parent, fs::path(folder_), fs::path(folder_) / kRecords})
    if (fs::exists(written, code) && ::access(written.c_str(), W_OK) != 0)
      throw Error(ExitCode::file,
                  std::string("cannot be written to (") + std::strerror(errno) + "), and new baselines come there",
                  {written.string()});
  coming_ = std::make_unique<TemporaryFile>(TemporaryFile::Kind::coming_folder, parent.string(), "", folder_,
                                            "its parent folder must take a new one");
  if (!old.exist()) return;
  copy_baselines(folder_, coming_->path());
  fs::permissions(coming_->path(), fs::status(folder_, code).permissions(), code);
}

std::string BaselineUpdate::keep_record(const Json& record) {
  const std::string text = text_of(record), id = sha256_of(text).substr(0, 16);
  const fs::path folder = fs::path(coming_->path()) / kRecords;
  const std::lock_guard lock(records_);  // many pictures share one
  std::error_code code;
  fs::create_directory(folder, code);
  const fs::path path = folder / (id + ".json");
  if (!fs::exists(path)) write_whole_file(path, text);
  return id;
}

void BaselineUpdate::set(const std::string& name, const SuiteShot& shot) {
  remove(name);
  const fs::path folder = coming_->path(), path = folder / picture_file_of(name);
  write_png(path.string(), shot.image, shot.memory.tags());
  Json facts{{"suite", suite_}, {"picture", name}};
  facts["png_sha256"] = sha256_of(read_plain_file(path.string()));
  facts["physics"] = shot.physics;
  for (const char* key : kRecordKeys)
    if (shot.physics.contains(key)) facts["physics"][key] = keep_record(shot.physics[key]);
  facts["page"] = shot.page;
  write_whole_file(folder / facts_file_of(name), text_of(facts));
}

// Links to the old files: a file is written anew, never into.
void BaselineUpdate::remove(const std::string& name) {
  std::error_code code;
  fs::remove(fs::path(coming_->path()) / picture_file_of(name), code);
  fs::remove(fs::path(coming_->path()) / facts_file_of(name), code);
}

void BaselineUpdate::set_cameras(const Cameras& cameras) {
  const fs::path path = fs::path(coming_->path()) / kCameraFile;
  std::error_code code;
  fs::create_directory(path.parent_path(), code);
  fs::remove(path, code);
  if (cameras.empty()) return;
  Json json = Json::object();
  for (const auto& [source, camera] : cameras) json[source] = numbers_of(camera);
  write_whole_file(path, text_of(json));
}

// What a picture cannot be asked for may be in use: then all records stay. Files that are no records of ours
// stay, too.
void BaselineUpdate::drop_unused_records() const {
  std::set<std::string> used;
  const fs::path folder = coming_->path();
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".json" || !entry.is_regular_file()) continue;
    const Json facts = parse_json(read_plain_file(entry.path().string(), kLargestFacts));
    if (!facts.is_object() || !facts.contains("physics") || !facts["physics"].is_object()) return;
    for (const char* key : kRecordKeys)
      if (facts["physics"].contains(key) && facts["physics"][key].is_string())
        used.insert(facts["physics"][key].get<std::string>() + ".json");
  }
  std::error_code code;
  if (!fs::is_directory(folder / kRecords, code)) return;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / kRecords))
    if (is_record(entry.path()) && !used.contains(entry.path().filename().string()))
      fs::remove(entry.path(), code);
}

// What is written anew has the mode of what it replaces; that of new files is up to the umask.
void BaselineUpdate::keep_modes() const {
  std::error_code code;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(coming_->path())) {
    const fs::file_status former =
        fs::status(fs::path(folder_) / entry.path().lexically_relative(coming_->path()), code);
    if (fs::exists(former) && former.permissions() != entry.status().permissions())
      fs::permissions(entry.path(), former.permissions(), code);
  }
}

void BaselineUpdate::commit() {
  drop_unused_records();
  keep_modes();
  const std::string parent = fs::path(coming_->path()).parent_path().string();
  sync_folder(coming_->path(), folder_);
  throw_if_interrupted();
  std::error_code code;
  if (!fs::exists(folder_, code)) {
    fs::rename(coming_->path(), folder_, code);
    if (code) throw Error(ExitCode::file, code.message(), {folder_});
    coming_->let_go();
  } else if (::syscall(SYS_renameat2, AT_FDCWD, coming_->path().c_str(), AT_FDCWD, folder_.c_str(),
                       RENAME_EXCHANGE) != 0) {
    throw Error(ExitCode::file, std::string("cannot be exchanged for the new ones: ") + std::strerror(errno),
                {folder_});
  }
  // What was exchanged stands under the hidden name now, and goes with it.
  sync_folder(parent, folder_);
}

}  // namespace chainreel
