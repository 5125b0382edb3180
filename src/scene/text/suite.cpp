#include "scene/text/suite.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "core/data_folder.hpp"
#include "core/format.hpp"
#include "core/json.hpp"
#include "model/read_chain.hpp"
#include "scene/keys/fields.hpp"
#include "scene/keys/keys.hpp"
#include "scene/text/asked_instant.hpp"
#include "scene/text/picture_names.hpp"
#include "scene/text/read_scene.hpp"
#include "scene/text/suite_models.hpp"
#include "scene/text/suite_poses.hpp"
#include "scene/text/suite_settings.hpp"
#include "scene/text/suite_variants.hpp"

namespace chainreel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDefaultFile = "snapshots.yaml";
constexpr std::size_t kMostPictures = 10'000;

constexpr Name kOtherPhysics[] = {{"fail", "other physics is a failure, be the pixels the same"},
                                  {"motion", "another method, step or tolerance is none as long as no coordinate moves by more than a thousandth of its range"},
                                  {"note", "it is said, no more, and what differs in the picture is weighed"}};

// Keys of scenes that a suite may set for all its pictures; sections with all that is in them.
const std::vector<std::string> kLookKeys{"base",    "massless", "packages", "end_effector", "links",
                                         "mesh_up", "camera",   "theme",    "text_scale"};

struct Source {
  std::string named;  // as the suite does
  std::string file;   // as found from the working folder
  std::string label;  // in names of pictures
  bool is_model = false;
  Place place;
};

bool is_yaml(const fs::path& path) {
  return path.extension() == ".yaml" || path.extension() == ".yml";
}

constexpr const char* kOfModel = "_model";  // behind the name of a model's picture, where its scene has that name

// The names of several sources differ: by their stems, else by their paths, else by their kinds.
void name_sources(std::vector<Source>& sources, const std::string& suite) {
  std::map<std::string, int> count;
  for (Source& source : sources) {
    source.label = fs::path(source.file).stem().string();
    ++count[source.label];
  }
  for (Source& source : sources)
    if (count[source.label] > 1) {
      const fs::path from =
          fs::path(source.file).lexically_relative(fs::path(suite).parent_path().lexically_normal());
      source.label =
          fs::path(from.empty() ? fs::path(source.file) : from).replace_extension().generic_string();
    }
  // A scene and its model, as `init` writes them.
  const auto is_scene_of = [](const Source& model) { return [&model](const Source& other) { return !other.is_model && other.label == model.label; }; };
  for (Source& source : sources)
    if (source.is_model && std::any_of(sources.begin(), sources.end(), is_scene_of(source))) source.label += kOfModel;
}

bool has_link(const UrdfFile& file, const std::string& name) {
  return std::any_of(file.links.begin(), file.links.end(), [&](const UrdfLink& link) { return link.name == name; });
}

class SuiteReader {
 public:
  explicit SuiteReader(const std::string& path)
      : document_(
            load_yaml(path, {}, "holds no suite: write `model: my_robot.urdf` and `poses: {home: [0, 0]}`")),
        root_(document_, document_.root, "", problems_) {
    suite_.file = path;
    suite_.name = fs::path(path).stem().string();
  }

  Suite read() {
    refuse_scene();
    read_sources("model", true);
    read_sources("scene", false);
    name_sources(sources_, suite_.file);
    for (const Source& source : sources_)
      if (source.is_model) models_.add(source.named, source.file);
    poses_.read(root_, suite_.file, models_);
    end_effectors_ = end_effectors_of(root_, models_);
    read_instants();
    variants_ = read_variants(root_, document_, problems_);
    for (const auto* list : {&variants_.own, &variants_.otherwise}) suite_.variants.insert(suite_.variants.end(), list->begin(), list->end());
    read_look();
    read_suite_settings(root_, common_);
    if (const auto index = root_.read_word("physics", kOtherPhysics)) suite_.other_physics = OtherPhysics(*index);
    read_own_settings();
    root_.finish("snapshots");
    check_together();
    make_pictures();
    problems_.throw_if_any();
    return std::move(suite_);
  }

 private:
  // A scene in a suite's place is one mistake, not an unknown key for each of its lines.
  void refuse_scene() {
    std::vector<std::string> own{"model", "poses", "at", "scene", "size", "tolerance", "masks", "pictures", "physics", "variants"};
    for (const auto& pair : document_.root) {
      const std::string& key = pair.first.Scalar();
      if (std::find(own.begin(), own.end(), key) != own.end()) continue;
      if (std::find(kLookKeys.begin(), kLookKeys.end(), key) != kLookKeys.end() || !find_key(key)) continue;
      throw Error(ExitCode::bad_input,
                  "'" + key + "' is a key of a scene: a suite names scenes, write a " +
                      std::string(kDefaultFile) +
                      " with `scene: " + fs::path(suite_.file).filename().string() + "` and `at: [0, 1.2s]`",
                  document_.place_of(pair.first, key));
    }
  }

  void read_sources(const std::string& key, bool is_model) {
    if (!root_.has(key)) return;
    const std::string like = is_model ? "model: my_robot.urdf" : "scene: [swing.yaml, fall.yaml]";
    for (const auto& [named, place] : texts_of(document_, root_.find(key), key, like, problems_)) {
      Source source{named, input_beside(suite_.file, named), "", is_model, place};
      std::error_code ignored;
      if (const std::string shipped = is_model || fs::exists(source.file, ignored) ? "" : shipped_file(named); is_yaml(shipped)) source.file = shipped;
      if (is_yaml(source.file) == is_model) {
        problems_.add("'" + named +
                          (is_model ? "' is no model: name scenes under `scene:`"
                                    : "' is no scene: name models under `model:`"),
                      place);
      } else if (require_file_of_suite(named, source.file, place, problems_)) {
        if (is_model && source.file != beside(suite_.file, named)) suite_.notes.push_back(not_there(named, "beside " + suite_.file, source.file));
        sources_.push_back(source);
      }
    }
  }

  void read_instants() {
    if (!root_.has("at")) return;
    for (const auto& [text, place] : texts_of(document_, root_.find("at"), "at", "at: [0, 1.2s, event touch]", problems_)) try {
        instants_.emplace_back(parse_asked_instant(text, place), place);
      } catch (const Error& error) {
        add_problems(error, problems_);
      }
  }

  // Keys of scenes are read and written by their rows.
  void read_look() {
    look_.file = suite_.file;
    std::optional<Fields> section;
    for (const SceneKey& key : scene_keys()) {
      if (key.section().empty() && section) {
        section->finish();
        section.reset();
      }
      const std::string top = key.section().empty() ? key.name : key.section();
      if (std::find(kLookKeys.begin(), kLookKeys.end(), top) == kLookKeys.end()) continue;
      if (key.is_section) {
        section = root_.section(key.name, "keys: " + key.example);
        continue;
      }
      Fields* fields = key.section().empty() ? &root_ : section ? &*section : nullptr;
      if (fields == nullptr || !fields->has(key.leaf()) || (key.name == "theme" && lists_themes(document_)) ||
          (key.name == "end_effector" && root_.find("end_effector").IsMap()))
        continue;
      key.read(key, *fields, look_);
      std::vector<SceneEntry> entries;
      key.write(key, look_, entries);
      for (const SceneEntry& entry : entries)
        if (entry.key != "camera.fit" && !entry.key.starts_with("packages."))
          set_of_all(entry.key + "=" + entry.text, fields->place_of(fields->find(key.leaf()), entry.key));
    }
    if (section) section->finish();
    suite_.fit = look_.camera.fit;
    // Overrides are read beside each scene or model, wherever that is.
    for (const auto& [name, folder] : look_.packages)
      set_of_all("packages." + name + "=" + Json(fs::absolute(folder).lexically_normal().string()).dump(),
                 document_.place_of(root_.find("packages"), "packages"));
  }

  void set_of_all(const std::string& override, const Place& place) {
    suite_.overrides.push_back(override);
    suite_.override_places.push_back(place);
  }

  void read_own_settings() {
    if (!root_.has("pictures")) return;
    std::optional<Fields> pictures =
        root_.section("pictures", "names of pictures: pictures: {home: {masks: [[0, 0, 80, 20]]}}");
    if (!pictures) return;
    for (const auto& pair : root_.find("pictures")) {
      const std::string& name = pair.first.Scalar();
      std::optional<Fields> fields =
          pictures->section(name, "what the picture has for itself: tolerance, masks, size");
      if (!fields) continue;
      SuiteSettings& own = own_[name];
      own.place = pictures->place_of(pair.first, name);
      read_suite_settings(*fields, own);
      fields->finish();
    }
  }

  void check_together() {
    const auto names_a = [&](bool model) {
      return std::any_of(sources_.begin(), sources_.end(),
                         [&](const Source& source) { return source.is_model == model; });
    };
    if (!root_.has("model") && !root_.has("scene"))
      problems_.add("the suite names nothing to show: write `model: my_robot.urdf` or `scene: swing.yaml`", {suite_.file});
    if (root_.has("poses") && !root_.has("model"))
      root_.problem_at("poses", "'poses' goes with `model:`; a scene takes `at: [0, 1.2s]`");
    if (root_.has("at") && !root_.has("scene"))
      root_.problem_at("at", "'at' goes with `scene:`; a model takes `poses: {home: [0, 0]}`");
    if (root_.has("base") && !names_a(true))
      root_.problem_at("base", "'base' goes with `model:`; a scene has its own");
  }

  void make_pictures() {
    std::set<std::string> shown;  // variants
    for (const Source& source : sources_) {
      for (const SuiteVariant& variant : variants_of(source)) {
        shown.insert(variant.name);
        variant_ = &variant;
        if (source.is_model)
          make_poses(source);
        else
          make_instants(source);
      }
      if (suite_.pictures.size() > kMostPictures)
        throw Error(ExitCode::limit, "makes more than " + std::to_string(kMostPictures) + " pictures: split it", {suite_.file});
    }
    for (const SuiteVariant& variant : variants_.own)
      if (!shown.contains(variant.name) && problems_.empty()) problems_.add(words_of_idle(variant), variant.place);
    if (problems_.empty()) poses_.tell_idle(joined(robots_), problems_);
    for (const auto& [name, own] : own_)
      if (!used_own_.contains(name) && problems_.empty()) {
        std::vector<std::string> names;
        for (const SuitePicture& picture : suite_.pictures) names.push_back(picture.name);
        problems_.add("there is no picture '" + name + "':" + did_you_mean(name, names) + " There are " +
                          shortened(joined(names), 400) + ".",
                      own.place);
      }
  }

  // Those that are about it.
  std::vector<SuiteVariant> variants_of(const Source& source) {
    std::vector<SuiteVariant> found;
    for (const SuiteVariant& variant : variants_.own)
      if (source.is_model ? is_about_models(variant) : is_about_scene(source.file, suite_.overrides, variant)) found.push_back(variant);
    return found.empty() ? variants_.otherwise : found;
  }

  void make_poses(const Source& source) try {
    ModelOptions options;
    options.floating_base = look_.base == RootLink::floating;
    options.massless = look_.massless;
    options.packages = look_.packages;
    const auto own = end_effectors_.find(source.file);
    options.end_effector = own == end_effectors_.end() ? look_.end_effector : own->second;
    const UrdfFile file = read_urdf_file(source.file);
    if (!look_.end_effector.empty() && models_.size() > 1 && !has_link(file, look_.end_effector))
      return root_.problem_at("end_effector", "'end_effector': " + source.named + " has no link '" + look_.end_effector +
                                                  "': of several models write end_effector: {" + source.named + ": LINK, ..}");
    const Chain chain = chain_of(file, options);
    if (robots_.empty() || !robots_.back().starts_with(source.file + " is ")) robots_.push_back(source.file + " is '" + file.name + "'");
    const std::vector<const WrittenPose*> poses = poses_.of(source.file, models_.size() == 1 ? std::nullopt : std::optional(file.name));
    // Poses may all be other models'.
    if (poses.empty() && !poses_.has_states()) add(source, "", source.place).q = resting_pose(chain);
    for (const WrittenPose* pose : poses)
      if (const auto q = pose_of(*pose, file, chain, problems_)) add(source, pose->name, pose->place).q = *q;
  } catch (const Error& error) {
    add_problems(error, problems_);
  }

  void make_instants(const Source& source) try {
    // What is wrong with the suite's own keys is told already, and not again by each of its scenes.
    const Scene scene = read_scene(source.file, problems_.empty() ? with_variant(suite_.overrides, *variant_) : std::vector<std::string>{});
    for (const std::string& note : scene.not_beside)
      if (std::find(suite_.notes.begin(), suite_.notes.end(), note) == suite_.notes.end()) suite_.notes.push_back(note);
    if (!root_.has("at")) add(source, "", source.place).telling = true;
    for (const auto& [asked, place] : instants_) {
      if (const std::string trouble = trouble_of_instant(asked, scene); !trouble.empty()) {
        problems_.add(trouble, place);
        continue;
      }
      SuitePicture& picture = add(source, asked.name(), place);
      picture.at = asked.at;
      picture.event = asked.event;
      picture.pose = asked.text;
    }
  } catch (const Error& error) {
    add_problems(as_said_in(suite_, error), problems_);
  }

  SuitePicture& add(const Source& source, const std::string& pose, const Place& place) {
    SuitePicture picture;
    const std::string name = pose.empty() ? source.label : sources_.size() == 1 ? pose : source.label + "_" + pose;
    picture.name = file_name_of(variant_->name.empty() ? name : name + "_" + variant_->name);
    picture.source = source.file;
    picture.variant = variant_->name;
    picture.overrides = with_variant({}, *variant_);
    if (const auto own = end_effectors_.find(source.file); own != end_effectors_.end())
      picture.overrides.insert(picture.overrides.begin(), "end_effector=" + Json(own->second).dump());
    picture.is_model = source.is_model;
    picture.pose = pose;
    picture.place = place;
    apply(common_, picture);
    if (const auto own = own_.find(picture.name); own != own_.end()) {
      apply(own->second, picture);
      used_own_.insert(picture.name);
    }
    check_masks(picture, problems_);
    names_.add(picture.name, place, problems_);
    suite_.pictures.push_back(std::move(picture));
    return suite_.pictures.back();
  }

  ProblemList problems_;
  YamlDocument document_;
  Fields root_;
  Suite suite_;
  Scene look_;  // what of a scene the suite sets
  std::vector<Source> sources_;
  SuiteVariants variants_;
  const SuiteVariant* variant_ = nullptr;  // of the pictures that are being made
  SuiteModels models_;
  std::map<std::string, std::string> end_effectors_;  // by files of models
  SuitePoses poses_;
  std::vector<std::string> robots_;
  std::vector<std::pair<AskedInstant, Place>> instants_;
  SuiteSettings common_;
  std::map<std::string, SuiteSettings> own_;  // by names of pictures
  std::set<std::string> used_own_;
  PictureNames names_;
};

// The scenes and models of a folder, not of those in it, by their names.
Suite suite_of_folder(const std::string& path) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path)) {
    const fs::path& file = entry.path();
    const bool is_shown = is_yaml(file) || file.extension() == ".urdf";
    if (is_shown && entry.is_regular_file() && file.filename().string().front() != '.') files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  Suite suite;
  suite.file = path;
  suite.name =
      fs::path(fs::absolute(path).lexically_normal().string() + "/").parent_path().filename().string();
  if (files.empty())
    throw Error(ExitCode::bad_input,
                "holds no scene (.yaml), no model (.urdf) and no " + std::string(kDefaultFile), {path});
  ProblemList problems, broken;
  std::size_t sound = 0;
  PictureNames names;
  for (const fs::path& file : files) {
    SuitePicture picture;
    const auto is_its_scene = [&file](const fs::path& other) { return is_yaml(other) && other.stem() == file.stem(); };
    const bool has_scene = !is_yaml(file) && std::any_of(files.begin(), files.end(), is_its_scene);
    picture.name = file_name_of(file.stem().string() + (has_scene ? kOfModel : ""));
    picture.source = file.lexically_normal().string();
    picture.is_model = !is_yaml(file);
    picture.telling = !picture.is_model;
    picture.place = {picture.source};
    // What cannot be read fails by itself, when its picture is drawn: nothing is lost of the others.
    try {
      if (picture.is_model)
        picture.q = resting_pose(read_chain(picture.source));
      else
        read_scene(picture.source);
      ++sound;
    } catch (const Error& error) {
      add_problems(error, broken);
    }
    names.add(picture.name, picture.place, problems);
    suite.pictures.push_back(std::move(picture));
  }
  problems.throw_if_any();
  if (sound == 0) broken.throw_if_any();
  return suite;
}

}  // namespace

Suite read_suite(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    const fs::path inside = fs::path(path) / kDefaultFile;
    return fs::is_regular_file(inside, ignored) ? SuiteReader(inside.string()).read() : suite_of_folder(path);
  }
  if (fs::exists(path, ignored) && !is_yaml(path))
    throw Error(ExitCode::bad_input,
                "is no suite: write a " + std::string(kDefaultFile) +
                    ", for example with `model: " + fs::path(path).filename().string() + "`",
                {path});
  return SuiteReader(path).read();
}

}  // namespace chainreel
