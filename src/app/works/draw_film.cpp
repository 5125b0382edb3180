#include "app/works/draw_film.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <system_error>

#include "app/cli/streams.hpp"
#include "app/works/joined_film.hpp"
#include "core/error.hpp"
#include "core/hash.hpp"
#include "core/input_file.hpp"
#include "core/machine.hpp"
#include "core/parallel.hpp"
#include "core/temporary_file.hpp"
#include "encode/libav_functions.hpp"
#include "encode/png.hpp"
#include "render/canvas.hpp"
#include "render/gl_backend.hpp"
#include "render/renderer_pins.hpp"

namespace chainreel {
namespace {

// Of what all share: libraries that are still to be loaded; of a thread with its canvas and one encoder, measured at
// 1920x1080, and the address space that it takes for its heap.
constexpr double kBytesOfProcess = 300e6, kBytesOfThread = 100e6, kBytesOfPixel = 90;
constexpr double kLongFilm = 20'000;  // frames, of all panels: runs and plots that take much memory, too

// A chunk depends on the program, too.
std::string chunk_key(const VideoSettings& s, const std::string& film_key) {
  static const std::string program = sha256_of_file("/proc/self/exe");
  const Json json{s.width, s.height, s.fps.num, s.fps.den, crf_of(s), int(s.codec), s.alpha};
  return sha256_of(program + film_key + json.dump());
}

// What chunks are kept beside. Parts of a sequence go into one folder, and have a store each.
std::string store_place(const Output& output, FrameRange range, int frames) {
  const bool is_share = output.folder && (range.first > 0 || range.behind < frames);
  return output.target.path + (is_share ? "." + std::to_string(range.first) + "-" + std::to_string(range.behind) : "");
}

// The pictures of a sequence from frame `first` to the one before `behind`: where they are being written.
std::vector<std::string> picture_paths(const Output& output, int first, int behind) {
  std::vector<std::string> paths;
  for (int frame = first; frame < behind; ++frame)
    paths.push_back((std::filesystem::path(output.folder->temporary_folder()) /
                     PngSequence::file_name(place_of_sequence(output.target.path).stem, frame))
                        .string());
  return paths;
}

// They are kept like the packets of a film, a file each.
FilmChunk chunk_of_pictures(const std::vector<std::string>& paths) {
  FilmChunk chunk{int(paths.size()), {}};
  for (const std::string& path : paths)
    chunk.packets.push_back({.data = read_plain_file(path), .opacity = "", .pts = std::int64_t(chunk.packets.size()), .is_key = true});
  return chunk;
}

void write_pictures(const FilmChunk& chunk, const std::vector<std::string>& paths) {
  for (std::size_t k = 0; k < paths.size(); ++k) {
    std::ofstream stream(paths[k], std::ios::binary);
    stream << chunk.packets[k].data;
    stream.close();
    if (!stream) throw Error(ExitCode::file, with_final_names(paths[k] + ": could not be written whole: is the disk full?"));
  }
}

// What lies under all frames. The renderer, which takes more memory than all else, goes when this is drawn.
std::shared_ptr<const StaticLayer> layer_under(const FilmWork& work) {
  std::shared_ptr<const StaticLayer> layer;
  {
    const Video& video = work.scene.video;
    Canvas canvas(work.renderer != nullptr ? std::move(*work.renderer) : ComingRenderer(video.width, video.height), work.fonts);
    canvas.set_static_layer(work.film.static_layer());
    layer = canvas.static_layer();
  }
  give_renderer_back();
  return layer;
}

// What one thread draws with.
class Pen {
 public:
  Pen(const FilmWork& work, std::shared_ptr<const StaticLayer> layer) : work_(work), canvas_(std::move(layer), work.fonts) {
    times.render += clock.lap();
  }

  // Good until the next call. A frame that stands there already is not drawn again, and has not changed.
  const Image& draw(int frame) {
    if (frame == drawn_) {
      changed_.clear();
      return *image_;
    }
    throw_if_interrupted();
    clock.lap();
    const Picture picture = work_.film.frame(frame);
    times.draw += clock.lap();
    const CanvasFrame& drawn = canvas_.draw(picture);
    image_ = &drawn.image;
    changed_ = drawn.changed;
    times.render += clock.lap();
    drawn_ = frame;
    return *image_;
  }
  // Where it differs from what was drawn before.
  const std::vector<PixelBox>& changed() const { return changed_; }

  StageTimes times;
  StageClock clock;

 private:
  const FilmWork& work_;
  Canvas canvas_;
  const Image* image_ = nullptr;  // the canvas's
  std::vector<PixelBox> changed_;
  int drawn_ = -1;
};

// All that threads share while they make a film.
class Workshop {
 public:
  Workshop(const FilmWork& work, std::vector<Output>& outputs);

  void run(StageTimes& times);

 private:
  enum class Kind { clip, stills, chunk };
  struct Piece {
    Kind kind;
    std::size_t index;  // of the output, or of the chunk
  };

  std::unique_ptr<JoinedFilm> joined_film(const Output& output) const;
  std::vector<int> chunks_of_range() const;
  void do_piece(const Piece& piece, Pen& pen);
  void draw_clip(Output& output, Pen& pen);
  void draw_stills(Pen& pen);
  void draw_chunk(std::size_t index, Pen& pen);
  void has_drawn();

  const FilmWork& work_;
  std::vector<Output>& outputs_;
  std::vector<std::unique_ptr<JoinedFilm>> films_;  // beside the outputs; none of what is no film
  std::vector<std::unique_ptr<const ChunkStore>> pictures_;  // likewise: of sequences, where finished chunks are kept
  std::vector<int> bounds_;                         // of the chunks
  std::vector<Piece> pieces_;
  Tags tags_;
  std::atomic<bool> ended_ = false;  // by an error
  std::mutex lock_;
  int drawn_ = 0;
  std::optional<Progress> progress_;
};

Workshop::Workshop(const FilmWork& work, std::vector<Output>& outputs)
    : work_(work), outputs_(outputs), tags_(work.memory.tags()) {
  bool has_chunks = false, has_stills = false;
  int frames = 0;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputFormat& format = *outputs[i].target.format;
    films_.emplace_back();
    pictures_.emplace_back();
    has_stills = has_stills || format.shows == Shows::still;
    if (format.shows != Shows::motion) continue;
    if (format.codec && work.tapes == nullptr) films_.back() = joined_film(outputs[i]);
    if (outputs[i].folder && !work.film_key.empty())
      pictures_.back() = std::make_unique<ChunkStore>(store_place(outputs[i], work.range, work.schedule.total()),
                                                      chunk_key(settings_of(format, work.scene, tags_), work.film_key));
    has_chunks = has_chunks || format.codec || format.is_sequence;
    if (format.make_clip == nullptr) continue;
    pieces_.push_back({Kind::clip, i});  // first, as they take longest
    frames += work.schedule.total();
  }
  if (has_stills) {
    pieces_.push_back({Kind::stills, 0});
    frames += 1;
  }
  if (has_chunks) {
    bounds_ = chunks_of_range();
    if (work.tapes != nullptr) work.tapes->resize(bounds_.size() - 1);
    for (std::size_t k = 0; k + 1 < bounds_.size(); ++k) pieces_.push_back({Kind::chunk, k});
    frames += work.range.behind - work.range.first;
  }
  if (!pieces_.empty()) progress_.emplace(work.scene.name, frames, work.quiet);
}

std::unique_ptr<JoinedFilm> Workshop::joined_film(const Output& output) const {
  VideoSettings settings = settings_of(*output.target.format, work_.scene, tags_);
  std::shared_ptr<const ChunkStore> store;
  if (!work_.film_key.empty()) store = std::make_shared<ChunkStore>(output.target.path, chunk_key(settings, work_.film_key));
  if (!work_.part.empty()) settings.tags[kPart] = work_.part;
  return std::make_unique<JoinedFilm>(output.temporary_path(), settings, std::move(store));
}

std::vector<int> Workshop::chunks_of_range() const {
  const auto [first, behind] = work_.range;
  const FrameRate fps = work_.scene.video.fps;
  FilmCuts cuts = cuts_of(outputs_, work_.schedule.total(), fps);
  if (cuts.are_fixed) {
    std::erase_if(cuts.bounds, [&](int bound) { return bound < first || bound > behind; });
    return cuts.bounds;
  }
  std::vector<int> bounds = chunk_bounds(behind - first, fps, {});
  for (int& bound : bounds) bound += first;
  return bounds;
}

void Workshop::run(StageTimes& times) {
  if (pieces_.empty()) return;
  const int jobs = std::min(work_.jobs, int(pieces_.size()));
  StageClock clock;
  const std::shared_ptr<const StaticLayer> layer = layer_under(work_);
  times.render += clock.lap();
  for_each_index_with_tools(pieces_.size(), jobs, [&]() -> RunIndex {
    // What the thread spent is told when its last piece is done, and goes with it.
    const std::shared_ptr<Pen> pen(new Pen(work_, layer), [&](Pen* used) {
      const std::lock_guard guard(lock_);
      times += used->times;
      delete used;
    });
    return [this, pen](std::size_t index) { do_piece(pieces_[index], *pen); };
  });
  clock.lap();
  for (const auto& film : films_)
    if (film) film->finish();
  films_.clear();
  pictures_.clear();
  for (const Output& output : outputs_)
    if (output.target.format->codec && !work_.part.empty()) seal_part(output.temporary_path(), output.target.path);
  times.mux += clock.lap();
}

void Workshop::do_piece(const Piece& piece, Pen& pen) {
  try {
    if (piece.kind == Kind::clip)
      draw_clip(outputs_[piece.index], pen);
    else if (piece.kind == Kind::stills)
      draw_stills(pen);
    else
      draw_chunk(piece.index, pen);
  } catch (...) {
    ended_ = true;
    throw;
  }
}

void Workshop::has_drawn() {
  const std::lock_guard guard(lock_);
  progress_->update(++drawn_);
}

void Workshop::draw_clip(Output& output, Pen& pen) {
  const OutputFormat& format = *output.target.format;
  const std::unique_ptr<FrameSink> sink =
      format.make_clip(output.temporary_path(), settings_of(format, work_.scene, tags_));
  for (int n = 0; n < work_.schedule.total() && !ended_; ++n, has_drawn()) {
    if (!sink->takes_next()) {
      sink->skip();
      continue;
    }
    const Image& image = pen.draw(work_.schedule.drawn(n));
    sink->write(image);
    pen.times.encode += pen.clock.lap();
  }
  if (ended_) return;
  sink->finish();
  pen.times.encode += pen.clock.lap();
}

void Workshop::draw_stills(Pen& pen) {
  // As a picture by itself, where words stand that fade in films.
  const auto picture = [&] { return work_.still_picture != nullptr ? *work_.still_picture : work_.film.still(work_.still); };
  const auto image = [&] { return rasterise(picture(), work_.scene.video.width, work_.scene.video.height, work_.fonts); };
  ClipMemory memory = work_.memory;
  memory.audit["at"] = work_.still_at;
  for (const Output& output : outputs_)
    if (output.shows(Shows::still))
      output.target.format->write_still(*output.files.front(), {picture, image, work_.scene.video.height, work_.fonts}, memory);
  pen.times.encode += pen.clock.lap();
  has_drawn();
}

void Workshop::draw_chunk(std::size_t index, Pen& pen) {
  const int first = bounds_[index], behind = bounds_[index + 1];
  std::vector<std::unique_ptr<FrameSink>> sinks;
  std::vector<std::pair<JoinedFilm*, ChunkEncoder*>> encoders;
  std::vector<std::size_t> sequences;  // which outputs
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const Output& output = outputs_[i];
    JoinedFilm* const film = films_[i].get();
    if (film != nullptr) {
      if (film->store() != nullptr)
        if (std::optional<FilmChunk> kept = film->store()->find(first, behind)) {
          film->take(index, std::move(*kept));
          continue;
        }
      auto encoder = std::make_unique<ChunkEncoder>(film->settings());
      encoders.emplace_back(film, encoder.get());
      sinks.push_back(std::move(encoder));
    } else if (output.target.format->codec) {
      sinks.push_back(std::make_unique<ChunkEncoder>(settings_of(*output.target.format, work_.scene, tags_),
                                                     &(*work_.tapes)[index]));
    } else if (output.folder) {
      if (pictures_[i])
        if (const std::optional<FilmChunk> kept = pictures_[i]->find(first, behind)) {
          write_pictures(*kept, picture_paths(output, first, behind));
          continue;
        }
      sequences.push_back(i);
      sinks.push_back(std::make_unique<PngSequence>(
          output.folder->temporary_folder(), place_of_sequence(output.target.path).stem, tags_, first));
    }
  }
  for (int n = first; n < behind && !ended_; ++n, has_drawn()) {
    if (sinks.empty()) continue;
    const Image& image = pen.draw(work_.schedule.drawn(n));
    for (const auto& sink : sinks) sink->write(image, pen.changed());
    pen.times.encode += pen.clock.lap();
  }
  if (ended_) return;
  for (const auto& sink : sinks) sink->finish();
  pen.times.encode += pen.clock.lap();
  for (const auto& [film, encoder] : encoders) {
    pen.times.convert += encoder->conversion();
    pen.times.encode -= encoder->conversion();
    FilmChunk chunk = encoder->take();
    if (film->store() != nullptr) film->store()->keep(first, behind, chunk);
    film->take(index, std::move(chunk));
  }
  for (const std::size_t i : sequences)
    if (pictures_[i]) pictures_[i]->keep(first, behind, chunk_of_pictures(picture_paths(outputs_[i], first, behind)));
  pen.times.mux += pen.clock.lap();
}

}  // namespace

Schedule schedule_of(const Runs& runs) {
  const Scene& scene = runs.film().scene;
  return {runs.frames_shown(runs.clock().frame_count()), frame_count(scene.hold.first, scene.video.fps),
          frame_count(scene.hold.last, scene.video.fps)};
}

StageTimes& StageTimes::operator+=(const StageTimes& other) {
  for (StageTime StageTimes::*stage : {&StageTimes::simulate, &StageTimes::draw, &StageTimes::render, &StageTimes::convert,
                                       &StageTimes::encode, &StageTimes::mux})
    this->*stage += other.*stage;
  return *this;
}

VideoSettings settings_of(const OutputFormat& format, const Scene& scene, const Tags& tags) {
  return {.width = scene.video.width,
          .height = scene.video.height,
          .fps = scene.video.fps,
          .crf = scene.video.crf,
          .codec = format.codec.value_or(VideoCodec::h264),
          .alpha = is_transparent(scene),
          .tags = tags};
}

FilmCuts cuts_of(const std::vector<Output>& outputs, int frames, FrameRate fps) {
  std::optional<VideoCodec> strictest;
  for (const Output& output : outputs)
    if (const auto codec = output.target.format->codec; codec && has_fixed_chunks(*codec)) strictest = codec;
  return {chunk_bounds(frames, fps, strictest), strictest.has_value()};
}

int affordable_jobs(int wanted, const Scene& scene, const std::vector<Output>& outputs) {
  const auto encoders =
      std::count_if(outputs.begin(), outputs.end(), [](const Output& output) { return output.target.format->codec; });
  const double bytes =
      kBytesOfThread + kBytesOfPixel * scene.video.width * scene.video.height * double(std::max(1L, long(encoders)));
  const int affordable = int(std::clamp((memory_limit() - kBytesOfProcess) / bytes, 1.0, 4096.0));
  if (wanted > affordable)
    std::fprintf(stderr, "note: %s: there is memory for --jobs %d only\n", scene.name.c_str(), affordable);
  return std::min(wanted > 0 ? wanted : usable_cores(), affordable);
}

std::optional<ComingRenderer> renderer_ahead(const std::vector<Output>& outputs, const Scene& scene, std::size_t panels) {
  const auto is_film = [](const Output& output) { return output.shows(Shows::motion) && !output.folder; };
  const auto is_picture = [](const Output& output) { return !output.shows(Shows::table); };
  if (std::none_of(outputs.begin(), outputs.end(), is_picture)) return {};
  const bool has_films = std::any_of(outputs.begin(), outputs.end(), is_film);
  const bool is_long = scene.duration * scene.video.fps.value() * double(panels) > kLongFilm;
  return ComingRenderer(scene.video.width, scene.video.height, is_long ? PageUse::long_film : PageUse::film, [has_films] {
    if (has_films) libav();
  });
}

void draw_film(const FilmWork& work, std::vector<Output>& outputs, StageTimes& times) {
  Workshop(work, outputs).run(times);
}

void forget_chunks(const std::vector<Output>& outputs, FrameRange range, int frames) {
  for (const Output& output : outputs)
    if (output.target.format->codec || output.folder) ChunkStore::forget(store_place(output, range, frames));
}

}  // namespace chainreel
